#pragma once

#include <filesystem>

#include "mpm/step.h"
#include "problems/engine/step_selection.h"

namespace conebench::mpm {

/// The problem of step `step`, named "<scene>_<step, 6 digits>", all stress nodes dry and without
/// gap; with_states() puts the law in. Takes the assembly's matrices. The only place in this folder
/// that makes a problem.
problems::Problem make_problem(const Scene& scene, std::int64_t step, double h, Assembly& assembly);

/// The problem for frozen states of the nodes.
problems::Problem with_states(const problems::Problem& base, const CohesionLaw& law,
                              const LawInput& input, const std::vector<NodeState>& states);

/// Writes the problems of a running simulation as files DIR/<scene>_<step, 6 digits>.h5, each with
/// geometry (nodes, volume fraction, state), the engine's guess, and its own solution with eta.
/// The law's states are frozen as they were solved last; kappa stands beside the unshifted f.
///
/// Errors: OutputError when the folder or a file cannot be written.
class Exporter {
 public:
  /// Makes the folder.
  Exporter(std::filesystem::path folder, engine::StepSelection selection);

  /// An Observer; hand it in with std::ref.
  void operator()(const StepView& view);

  std::int64_t written() const { return written_; }
  /// Selected steps without particles, hence without a problem.
  std::int64_t without_cones() const { return without_cones_; }

 private:
  std::filesystem::path folder_;
  engine::StepSelection selection_;
  std::int64_t written_ = 0;
  std::int64_t without_cones_ = 0;
};

}  // namespace conebench::mpm
