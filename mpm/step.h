#pragma once

#include <functional>

#include "mpm/assembly.h"
#include "problems/engine/step_solver.h"

namespace conebench::mpm {

/// What an observer sees after each step; without a problem when no particle is left.
struct StepView : engine::SolvedStep {
  double h = 0.0;  ///< size of the step [s]
  const Scene* scene = nullptr;
  const Particles* particles = nullptr;                   ///< at the end of the step
  const std::vector<RigidBody>* bodies = nullptr;         ///< at the end of the step
  const std::vector<RigidBody>* bodies_before = nullptr;  ///< where the problem was made
  const Nodes* nodes = nullptr;  ///< at its beginning, where the problem was made
  const std::vector<Eigen::Vector3d>* velocity = nullptr;  ///< of the nodes, after the solve [m/s]
  const Assembly* assembly = nullptr;
  const std::vector<NodeState>* states = nullptr;  ///< of the nodes, as solved
};

using Observer = std::function<void(const StepView&)>;

}  // namespace conebench::mpm
