#pragma once

#include <filesystem>
#include <vector>

#include "dem/placement.h"
#include "dem/step.h"
#include "problems/engine/vtk.h"

namespace conebench::dem {

/// Writes a running simulation for ParaView: XML poly data, text, one file of each kind a written
/// step,
///
///   spheres_000042.vtp   balls, as points: radius_m, velocity_m_s, angular_velocity_rad_s,
///                        speed_m_s
///   solids_000042.vtp    faces of all other bodies, round ones in facets: velocity_m_s of the
///                        face's middle, speed_m_s, body (index in Bodies), free (0 or 1)
///   contacts_000042.vtp  points: force_N (on the first body), normal, gap_m, bonded
///   spheres.pvd, solids.pvd, contacts.pvd   the time series; open these
///
/// Scenes without balls have no spheres, those of balls alone no solids. In ParaView, show
/// spheres.pvd through a Glyph filter of type Sphere scaled by 2 radius_m.
/// Errors: OutputError when the folder or a file cannot be written.
class VtkWriter {
 public:
  /// Makes the folder. Writes every `stride`-th step, the first included; stride >= 1.
  VtkWriter(std::filesystem::path folder, double step_s, const Placement& start,
            std::int64_t stride);

  /// An Observer; hand it in with std::ref.
  void operator()(const StepView& view);

  /// Writes the .pvd files; call it once, after the last step.
  void finish() const;

 private:
  std::string solids_file(const Bodies& bodies) const;

  std::filesystem::path folder_;
  double step_s_;
  std::int64_t stride_;
  std::vector<int> balls_, others_;    // bodies
  std::vector<Polyhedron> polyhedra_;  // of each solid, in the body's frame
  std::vector<engine::VtkStep> steps_;
};

}  // namespace conebench::dem
