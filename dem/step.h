#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "dem/contacts.h"
#include "problems/problem.h"

namespace conebench::dem {

/// What a step solver gives back: r' of the standard problem, the best it knows whatever happened.
struct StepAnswer {
  Eigen::VectorXd r;  ///< rows() entries [N s]
  bool converged = false;
  std::string status;  ///< in the solver's words, e.g. "time_limit"
  std::int64_t iterations = 0;
  double solve_s = 0.0;
};

/// Solves the cone problem of a step, starting from `guess` (r', rows() entries). The engines know
/// no solver; the program hands one in.
using StepSolver =
    std::function<StepAnswer(const problems::Problem& standard, const Eigen::VectorXd& guess)>;

/// What an observer sees after each step. Valid during the call only.
struct StepView {
  std::int64_t step = 0;                  ///< 0 for the first
  double time_s = 0.0;                    ///< at the end of the step
  const Spheres* spheres = nullptr;       ///< at the end of the step
  const Spheres* before = nullptr;        ///< at its beginning, where the problem was made
  const ContactList* contacts = nullptr;  ///< with the reactions of this step
  std::span<const int> entered;           ///< of each cone: its contact's index in the list

  /// Null when no contact entered: the step was free flight.
  const problems::Problem* problem = nullptr;   ///< as it is, with kappa
  const problems::Problem* standard = nullptr;  ///< problem->shifted()
  const Eigen::VectorXd* guess = nullptr;       ///< r'
  const StepAnswer* answer = nullptr;
};

using Observer = std::function<void(const StepView&)>;

}  // namespace conebench::dem
