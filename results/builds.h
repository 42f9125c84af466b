#pragma once

#include <map>
#include <set>
#include <span>
#include <string>

#include "results/one_host.h"
#include "results/record.h"

namespace conebench::results {

/// Names solvers so that two builds of one, run under the same settings, are two: results of
/// different programs are never taken for repetitions.
class Builds {
 public:
  explicit Builds(std::span<const Record> records);
  /// Of the records that count; only those have a name.
  Builds(std::span<const Record> records, const OneHost& hosts);

  /// "gs", or "gs@1a2b3c4d" (its build) where there are several.
  std::string name(const Record& record) const;

 private:
  std::map<std::string, std::set<std::string>> of_solver_;  // by settings and solver
};

}  // namespace conebench::results
