#pragma once

#include <limits>
#include <string>

#include "solvers/solver.h"

namespace conebench::harness {

/// One solve as it looks from outside: whatever the solver does is an entry of a table.
struct Attempt {
  enum class End {
    kReturned,    ///< a Result
    kInputError,  ///< threw problems::InputError
    kThrew,       ///< threw anything else
    kDied,        ///< crashed, left by exit(), or was killed kPatience_s after its limit
    kRefused,     ///< supports() says no; nothing was run
  };
  static constexpr double kPatience_s = 10.0;  ///< after the time limit, then it is killed
  static constexpr double kGrace_s = 2.0;      ///< after the time limit, then it is at fault

  End end = End::kDied;
  double wall_s = 0.0;  ///< set-up and judging included
  std::string text;     ///< of the exception, or how it died

  // The rest is of kReturned only.
  solvers::Status status = solvers::Status::kUnsupported;
  Eigen::VectorXd r;            ///< r' as it was returned; empty if of the wrong length
  Eigen::VectorXd certificate;  ///< of kInfeasible, as r
  double eta = std::numeric_limits<double>::infinity();  ///< of r, judged here
  std::int64_t iterations = 0;

  bool solved(double tol) const { return eta <= tol; }
};

/// Solves the standard problem of `problem` in a process of its own.
Attempt attempt(const solvers::Solver& solver, const problems::Problem& problem,
                const solvers::Stop& stop, const Eigen::VectorXd& guess = {});

/// "converged", ... where it returned, else "InputError", "threw", "died" or "refused".
std::string ending(const Attempt& attempt);

/// What no solver may do, whatever the problem: throw, die, return NaN, overrun the time limit by
/// more than kGrace_s, say `converged` with eta > tol or anything else with eta <= tol
/// (StopTest::kCommon), say `infeasible` without a proof. Empty if it did none of it.
std::string fault(const Attempt& attempt, const problems::Problem& problem,
                  const solvers::Stop& stop);

}  // namespace conebench::harness
