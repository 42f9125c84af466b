#pragma once

#include <optional>
#include <span>
#include <string_view>

namespace conebench::results {

/// How a task ended. The first seven are the solver's own words (solvers::Status), the others are
/// the judge's.
enum class Status {
  kConverged,       ///< the stopping test met the tolerance
  kIterationLimit,  ///< the solver used up its iterations
  kTimeLimit,       ///< the solver used up its time and stopped by itself
  kStalled,         ///< the iterate stopped moving above the tolerance
  kDiverged,        ///< the solver met a NaN or an infinity
  kInfeasible,      ///< proved to have no solution (a model's: its own word)
  kUnsupported,     ///< not a problem for this solver
  kCrashed,         ///< the worker died, or the solver threw; `error` says how
  kKilledTime,      ///< the worker was stopped at the hard limit
  kKilledMemory,    ///< the worker ran out of its memory
  kNotFinite,       ///< the answer, or its residual, holds a NaN or an infinity
  kRefuted,         ///< the solver claimed success and the verified eta is above the tolerance, or
                    ///< that there is no solution, without a proof
  kBadOutput,       ///< the answer has the wrong length
  kBadAbi,          ///< a plugin that speaks another version
};

/// Every status, in the order above.
std::span<const Status> all_statuses();

/// "converged", "killed_time", ...: the names used in files and tables.
std::string_view to_string(Status status);

/// The status of that name, or nothing.
std::optional<Status> status_from(std::string_view name);

}  // namespace conebench::results
