#include "results/status.h"

#include <algorithm>
#include <array>

namespace conebench::results {

std::span<const Status> all_statuses() {
  static constexpr std::array kAll = {
      Status::kConverged,  Status::kIterationLimit, Status::kTimeLimit,   Status::kStalled,
      Status::kDiverged,   Status::kInfeasible,     Status::kUnsupported, Status::kCrashed,
      Status::kKilledTime, Status::kKilledMemory,   Status::kNotFinite,   Status::kRefuted,
      Status::kBadOutput,  Status::kBadAbi,
  };
  return kAll;
}

std::string_view to_string(Status status) {
  switch (status) {
    case Status::kConverged:
      return "converged";
    case Status::kIterationLimit:
      return "iteration_limit";
    case Status::kTimeLimit:
      return "time_limit";
    case Status::kStalled:
      return "stalled";
    case Status::kDiverged:
      return "diverged";
    case Status::kInfeasible:
      return "infeasible";
    case Status::kUnsupported:
      return "unsupported";
    case Status::kCrashed:
      return "crashed";
    case Status::kKilledTime:
      return "killed_time";
    case Status::kKilledMemory:
      return "killed_memory";
    case Status::kNotFinite:
      return "not_finite";
    case Status::kRefuted:
      return "refuted";
    case Status::kBadOutput:
      return "bad_output";
    case Status::kBadAbi:
      return "bad_abi";
  }
  return "unknown";
}

std::optional<Status> status_from(std::string_view name) {
  const auto all = all_statuses();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](Status s) { return to_string(s) == name; });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

}  // namespace conebench::results
