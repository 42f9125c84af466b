#include "results/one_host.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace conebench::results {
namespace {

// What is solved, and under which rules.
std::string key_of(const Record& record) {
  const Settings& s = record.settings;
  const std::string& what =
      record.sequence.id.empty() ? record.problem.content_sha256 : record.sequence.id;
  return fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}", what, s.tol, s.time_limit_s,
                     s.memory_limit_bytes, s.stop, s.mode, s.threads, s.timing);
}

// What was done on one class of hosts.
struct Work {
  std::set<std::string> solvers{};  // with build and donor
  std::string latest{};             // start

  bool operator<(const Work& other) const {
    return solvers.size() != other.solvers.size() ? solvers.size() < other.solvers.size()
                                                  : latest < other.latest;
  }
};

using Works = std::map<std::string, Work>;  // by class of hosts

std::map<std::string, Works> works_of(std::span<const Record> records) {
  std::map<std::string, Works> all;
  for (const Record& record : records) {
    Work& work = all[key_of(record)][record.host.host_class()];
    work.solvers.insert(record.solver + "\n" + record.solver_build + "\n" + record.donor);
    work.latest = std::max(work.latest, record.started_at);
  }
  return all;
}

bool one_class(std::span<const Record> records) {
  return std::all_of(records.begin(), records.end(), [&](const Record& record) {
    return record.host.cpu == records.front().host.cpu &&
           record.host.cores == records.front().host.cores;
  });
}

}  // namespace

OneHost::OneHost(std::span<const Record> records) {
  if (one_class(records)) return;
  for (const auto& [key, works] : works_of(records)) {
    const auto chosen =
        std::max_element(works.begin(), works.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    class_of_[key] = chosen->first;
  }
  left_out_ = static_cast<std::size_t>(std::count_if(
      records.begin(), records.end(), [&](const Record& record) { return !counts(record); }));
}

bool OneHost::counts(const Record& record) const {
  const auto chosen = class_of_.empty() ? class_of_.end() : class_of_.find(key_of(record));
  return chosen == class_of_.end() || chosen->second == record.host.host_class();
}

}  // namespace conebench::results
