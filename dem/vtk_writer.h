#pragma once

#include <filesystem>
#include <vector>

#include "dem/step.h"
#include "problems/engine/vtk.h"

namespace conebench::dem {

/// Writes a running simulation for ParaView: XML poly data, text, one pair of files a written step,
///
///   spheres_000042.vtp   point data: radius_m, velocity_m_s, angular_velocity_rad_s, speed_m_s
///   contacts_000042.vtp  point data: force_N (on the first body), normal, gap_m, bonded
///   spheres.pvd, contacts.pvd   the time series; open these
///
/// In ParaView, show spheres.pvd through a Glyph filter of type Sphere scaled by 2 radius_m.
/// Errors: OutputError when the folder or a file cannot be written.
class VtkWriter {
 public:
  /// Makes the folder. Writes every `stride`-th step, the first included; stride >= 1.
  VtkWriter(std::filesystem::path folder, double step_s, std::int64_t stride);

  /// An Observer; hand it in with std::ref.
  void operator()(const StepView& view);

  /// Writes the two .pvd files; call it once, after the last step.
  void finish() const;

 private:
  std::filesystem::path folder_;
  double step_s_;
  std::int64_t stride_;
  std::vector<engine::VtkStep> steps_;
};

}  // namespace conebench::dem
