#pragma once

#include "dem/assembly.h"
#include "dem/step.h"
#include "problems/engine/exporter.h"

namespace conebench::dem {

/// The problem of step `step`, named "<scene>_<step, 6 digits>". Takes the assembly's matrices.
/// The only place in this folder that makes a problem.
problems::Problem make_problem(const Scene& scene, std::int64_t step, Assembly& assembly);

/// An exporter whose geometry is the contacts and bodies at the beginning of the step.
class Exporter : public engine::Exporter {
 public:
  using engine::Exporter::Exporter;

  /// An Observer; hand it in with std::ref.
  void operator()(const StepView& view);

  /// Selected steps that had no contact, hence no problem.
  std::int64_t without_contacts() const { return without_problem(); }
};

}  // namespace conebench::dem
