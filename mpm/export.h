#pragma once

#include "mpm/step.h"
#include "problems/engine/exporter.h"

namespace conebench::mpm {

/// The problem of step `step`, named "<scene>_<step, 6 digits>", all stress nodes dry and without
/// gap; with_states() puts the law in. Takes the assembly's matrices. The only place in this folder
/// that makes a problem.
problems::Problem make_problem(const Scene& scene, std::int64_t step, double h, Assembly& assembly);

/// The problem for frozen states of the nodes.
problems::Problem with_states(const problems::Problem& base, const CohesionLaw& law,
                              const LawInput& input, const std::vector<NodeState>& states);

/// An exporter whose geometry is the nodes, volume fractions and states. The law's states are
/// frozen as they were solved last; kappa stands beside the unshifted f.
class Exporter : public engine::Exporter {
 public:
  using engine::Exporter::Exporter;

  /// An Observer; hand it in with std::ref.
  void operator()(const StepView& view);

  /// Selected steps without particles, hence without a problem.
  std::int64_t without_cones() const { return without_problem(); }
};

}  // namespace conebench::mpm
