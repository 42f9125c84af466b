#pragma once

#include <functional>

#include "mpm/assembly.h"
#include "problems/engine/step_solver.h"

namespace conebench::mpm {

/// What an observer sees after each step. Valid during the call only.
struct StepView {
  std::int64_t step = 0;  ///< 0 for the first; one cone problem a step
  double time_s = 0.0;    ///< at the end of the step
  double h = 0.0;         ///< size of the step [s]
  const Scene* scene = nullptr;
  const Particles* particles = nullptr;                   ///< at the end of the step
  const std::vector<RigidBody>* bodies = nullptr;         ///< at the end of the step
  const std::vector<RigidBody>* bodies_before = nullptr;  ///< where the problem was made
  const Nodes* nodes = nullptr;  ///< at its beginning, where the problem was made
  const std::vector<Eigen::Vector3d>* velocity = nullptr;  ///< of the nodes, after the solve [m/s]
  const Assembly* assembly = nullptr;
  const std::vector<NodeState>* states = nullptr;  ///< of the nodes, as solved

  /// Null when no particle is left.
  const problems::Problem* problem = nullptr;   ///< as it is, with kappa
  const problems::Problem* standard = nullptr;  ///< problem->shifted()
  const Eigen::VectorXd* guess = nullptr;       ///< r'
  const engine::StepAnswer* answer = nullptr;
};

using Observer = std::function<void(const StepView&)>;

}  // namespace conebench::mpm
