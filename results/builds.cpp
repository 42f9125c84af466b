#include "results/builds.h"

#include <fmt/format.h>

namespace conebench::results {
namespace {

constexpr std::size_t kShownDigits = 8;

std::string key_of(const Record& record) {
  const Settings& s = record.settings;
  return fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}", record.solver, s.tol, s.time_limit_s,
                     s.memory_limit_bytes, s.stop, s.mode, s.threads, s.timing);
}

}  // namespace

Builds::Builds(std::span<const Record> records) {
  for (const Record& record : records) of_solver_[key_of(record)].insert(record.solver_build);
}

Builds::Builds(std::span<const Record> records, const OneHost& hosts) {
  for (const Record& record : records) {
    if (hosts.counts(record)) of_solver_[key_of(record)].insert(record.solver_build);
  }
}

std::string Builds::name(const Record& record) const {
  if (of_solver_.at(key_of(record)).size() == 1) return record.solver;
  return record.solver + "@" + record.solver_build.substr(0, kShownDigits);
}

}  // namespace conebench::results
