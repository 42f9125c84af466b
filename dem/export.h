#pragma once

#include <filesystem>
#include <limits>
#include <string_view>

#include "dem/assembly.h"
#include "dem/step.h"

namespace conebench::dem {

/// The problem of step `step`, named "<scene>_<step, 6 digits>". Takes the assembly's matrices.
/// The only place in this folder that makes a problem.
problems::Problem make_problem(const Scene& scene, std::int64_t step, Assembly& assembly);

/// Which steps are written: first <= step <= last, every `stride`-th counted from `first`.
struct StepSelection {
  std::int64_t first = 0;
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::int64_t stride = 1;  ///< >= 1; becomes the problem's sampling_weight

  bool contains(std::int64_t step) const {
    return step >= first && step <= last && (step - first) % stride == 0;
  }
};

/// Reads "all", "every:N" or "N..M". Throws InputError.
StepSelection parse_selection(std::string_view text);

/// Writes the problems of a running simulation as files DIR/<scene>_<step, 6 digits>.h5, each with
/// geometry (at the beginning of the step), the engine's guess, and its own solution with eta.
///
/// Errors: OutputError when the folder or a file cannot be written.
class Exporter {
 public:
  /// Makes the folder.
  Exporter(std::filesystem::path folder, StepSelection selection);

  /// An Observer; hand it in with std::ref.
  void operator()(const StepView& view);

  std::int64_t written() const { return written_; }
  /// Selected steps that had no contact, hence no problem.
  std::int64_t without_contacts() const { return without_contacts_; }

 private:
  std::filesystem::path folder_;
  StepSelection selection_;
  std::int64_t written_ = 0;
  std::int64_t without_contacts_ = 0;
};

}  // namespace conebench::dem
