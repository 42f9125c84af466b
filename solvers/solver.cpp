#include "solvers/solver.h"

#include "problems/error.h"

namespace conebench::solvers {

using problems::require;

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
  }
  return "unknown";
}

std::string_view to_string(Kind kind) {
  switch (kind) {
    case Kind::kMethod:
      return "method";
    case Kind::kModel:
      return "model";
    case Kind::kPeer:
      return "peer";
  }
  return "unknown";
}

void Stop::check() const {
  require(tol > 0.0, "stop", "tol = ", tol, ", expected > 0");
  require(max_iterations >= 0, "stop", "max_iterations = ", max_iterations, ", expected >= 0");
  require(time_limit_s > 0.0, "stop", "time limit = ", time_limit_s, " s, expected > 0");
  require(look_growth > 0.0, "stop", "look growth = ", look_growth, ", expected > 0");
}

}  // namespace conebench::solvers
