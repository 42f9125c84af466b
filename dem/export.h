#pragma once

#include <filesystem>

#include "dem/assembly.h"
#include "dem/step.h"
#include "problems/engine/step_selection.h"

namespace conebench::dem {

/// The problem of step `step`, named "<scene>_<step, 6 digits>". Takes the assembly's matrices.
/// The only place in this folder that makes a problem.
problems::Problem make_problem(const Scene& scene, std::int64_t step, Assembly& assembly);

/// Writes the problems of a running simulation as files DIR/<scene>_<step, 6 digits>.h5, each with
/// geometry (at the beginning of the step), the engine's guess, and its own solution with eta.
///
/// Errors: OutputError when the folder or a file cannot be written.
class Exporter {
 public:
  /// Makes the folder.
  Exporter(std::filesystem::path folder, engine::StepSelection selection);

  /// An Observer; hand it in with std::ref.
  void operator()(const StepView& view);

  std::int64_t written() const { return written_; }
  /// Selected steps that had no contact, hence no problem.
  std::int64_t without_contacts() const { return without_contacts_; }

 private:
  std::filesystem::path folder_;
  engine::StepSelection selection_;
  std::int64_t written_ = 0;
  std::int64_t without_contacts_ = 0;
};

}  // namespace conebench::dem
