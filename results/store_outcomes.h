#pragma once

// Internal to the store: what the repetitions of a task come to. See results/store.h.

#include <cstdint>
#include <tuple>
#include <vector>

#include "results/record.h"

namespace SQLite {
class Database;
}

namespace conebench::results {

/// One repetition of a task, and the ids of what it belongs to.
struct Run {
  std::int64_t settings, contender, problem;
  const Record* record;
  auto key() const { return std::tuple(settings, contender, problem); }
};

/// Fills the tables `outcome` and `solved`. Throws SQLite::Exception.
void write_all_outcomes(SQLite::Database& database, std::vector<Run> runs);

}  // namespace conebench::results
