#include "mpm/cohesion_law.h"

#include <algorithm>

namespace conebench::mpm {

std::vector<NodeState> CohesionLaw::classify(const LawInput& input) const {
  std::vector<NodeState> states(static_cast<std::size_t>(input.density.size()));
  for (std::size_t i = 0; i < states.size(); ++i) {
    const bool dense = input.density[static_cast<Eigen::Index>(i)] >= kDense;
    states[i] = dense ? NodeState::kDense : NodeState::kLoose;
  }
  return states;
}

NodeLaw CohesionLaw::law_of(const LawInput& input, int node, NodeState state) const {
  const bool cohesive = state != NodeState::kLoose && input.tip[node] > 0.0;
  return cohesive ? NodeLaw{input.tip[node], 0.0} : NodeLaw{0.0, input.gap[node]};
}

NodeLaw UniformLaw::law_of(const LawInput& input, int node, NodeState) const {
  return {input.tip[node], input.gap[node]};
}

NodeLaw DenseOnlyLaw::law_of(const LawInput& input, int node, NodeState state) const {
  NodeLaw law = CohesionLaw::law_of(input, node, state);
  law.kappa *= std::clamp((input.density[node] - kDense) / (1.0 - kDense), 0.0, 1.0);
  return law;
}

std::vector<NodeState> DilationAwareLaw::classify(const LawInput& input) const {
  std::vector<NodeState> states = CohesionLaw::classify(input);
  const double allowed = -kTolerance * input.free_rate.cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < states.size(); ++i) {
    const bool dilates = input.free_rate[static_cast<Eigen::Index>(i)] >= allowed;
    if (states[i] == NodeState::kLoose && dilates) states[i] = NodeState::kBonded;
  }
  return states;
}

std::unique_ptr<CohesionLaw> make_law(Law law) {
  switch (law) {
    case Law::kUniform:
      return std::make_unique<UniformLaw>();
    case Law::kDenseOnly:
      return std::make_unique<DenseOnlyLaw>();
    case Law::kDilationAware:
      return std::make_unique<DilationAwareLaw>();
    case Law::kMonotone:
      return std::make_unique<MonotoneLaw>();
  }
  return nullptr;
}

}  // namespace conebench::mpm
