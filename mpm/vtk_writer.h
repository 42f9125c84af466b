#pragma once

#include <filesystem>
#include <vector>

#include "mpm/step.h"
#include "problems/engine/vtk.h"

namespace conebench::mpm {

/// Writes a running simulation for ParaView: XML poly data, text, one pair of files a written step,
///
///   particles_000042.vtp  point data: velocity_m_s, speed_m_s, volume_m3, cohesion_Pa, pressure_Pa
///   nodes_000042.vtp      point data: volume_fraction, state, velocity_m_s, pressure_Pa,
///                         shear_stress_Pa
///   particles.pvd, nodes.pvd   the time series; open these
///
/// Errors: OutputError when the folder or a file cannot be written.
class VtkWriter {
 public:
  /// Makes the folder. Writes every `stride`-th step, the first included; stride >= 1.
  VtkWriter(std::filesystem::path folder, std::int64_t stride);

  /// An Observer; hand it in with std::ref.
  void operator()(const StepView& view);

  /// Writes the two .pvd files; call it once, after the last step.
  void finish() const;

 private:
  std::filesystem::path folder_;
  std::int64_t stride_;
  std::vector<engine::VtkStep> steps_;
};

}  // namespace conebench::mpm
