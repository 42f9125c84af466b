#pragma once

#include <functional>
#include <span>

#include "dem/contacts.h"
#include "problems/engine/step_solver.h"

namespace conebench::dem {

/// What an observer sees after each step; without a problem when no contact entered: free flight.
struct StepView : engine::SolvedStep {
  int dimension = 3;                      ///< of the scene
  const Bodies* bodies = nullptr;         ///< at the end of the step
  const Bodies* before = nullptr;         ///< at its beginning, where the problem was made
  const ContactList* contacts = nullptr;  ///< with the reactions of this step
  std::span<const int> entered;           ///< of each cone: its contact's index in the list
};

using Observer = std::function<void(const StepView&)>;

}  // namespace conebench::dem
