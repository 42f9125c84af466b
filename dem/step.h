#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "dem/contacts.h"
#include "problems/engine/step_solver.h"

namespace conebench::dem {

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
  const engine::StepAnswer* answer = nullptr;
};

using Observer = std::function<void(const StepView&)>;

}  // namespace conebench::dem
