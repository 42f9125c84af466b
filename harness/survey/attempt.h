#pragma once

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
  solvers::Status status = solvers::Status::kUnsupported;
  Eigen::VectorXd r;  ///< r' as it was returned
  double eta = 0.0;   ///< of r, judged here; infinite where r is not finite
  std::int64_t iterations = 0;
  double wall_s = 0.0;  ///< set-up and judging included
  std::string text;     ///< of the exception, or how it died

  bool solved(double tol) const { return end == End::kReturned && eta <= tol; }
};

/// Solves the standard problem of `problem` in a process of its own.
Attempt attempt(const solvers::Solver& solver, const problems::Problem& problem,
                const solvers::Stop& stop, const Eigen::VectorXd& guess = {});

/// What no solver may do, whatever the problem: throw, die, return NaN, claim convergence with
/// eta > tol (StopTest::kCommon), give up the time limit. Empty if it did none of it.
std::string fault(const Attempt& attempt, const problems::Problem& problem,
                  const solvers::Stop& stop);

}  // namespace conebench::harness
