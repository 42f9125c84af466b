#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "problems/problem.h"

namespace conebench::engine {

/// How a scene wants its steps solved.
struct SolverChoice {
  std::string name = "auto";
  double tol = 1e-5;         ///< on eta
  double time_limit_s = 10;  ///< of one step; a step that it ends depends on the machine
  std::int64_t max_iterations = 1'000'000;  ///< of one step; ends it alike everywhere
};

/// What a step solver gives back: r' of the standard problem, the best it knows whatever happened.
struct StepAnswer {
  Eigen::VectorXd r;  ///< rows() entries [force_unit]
  bool converged = false;
  std::string status;  ///< in the solver's words, e.g. "time_limit"
  std::int64_t iterations = 0;
  double solve_s = 0.0;
};

/// Solves the cone problem of a step, starting from `guess` (r', rows() entries). The engines know
/// no solver; the program hands one in.
using StepSolver =
    std::function<StepAnswer(const problems::Problem& standard, const Eigen::VectorXd& guess)>;

/// A step as an observer sees it afterwards. Valid during the call only.
struct SolvedStep {
  std::int64_t step = 0;  ///< 0 for the first
  double time_s = 0.0;    ///< at the end of the step

  /// Null when the step had no cone.
  const problems::Problem* problem = nullptr;   ///< as it is, with kappa
  const problems::Problem* standard = nullptr;  ///< problem->shifted()
  const Eigen::VectorXd* guess = nullptr;       ///< r'
  const StepAnswer* answer = nullptr;
};

/// Throws std::runtime_error naming scene, step and status unless the answer has `rows` finite
/// numbers.
void check_answer(const StepAnswer& answer, Eigen::Index rows, std::string_view scene,
                  std::int64_t step);

}  // namespace conebench::engine
