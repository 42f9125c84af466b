#pragma once

#include <span>
#include <string>
#include <vector>

#include "mpm/simulation.h"

namespace conebench::mpm {

enum class ColourBy { kFraction, kSpeed };

/// One moment of a simulation, as much of it as a picture needs.
struct Frame {
  double time_s = 0.0;
  std::vector<Eigen::Vector3d> positions;  ///< [m]
  std::vector<double> speeds;              ///< [m/s]
  std::vector<double> fractions;           ///< volume fraction at the particle [-]
  std::vector<RigidBody> bodies;
  std::vector<bool> cut;  ///< cells that are cut in half, see Mesh; empty: the grid has none
};

Frame make_frame(const Simulation& simulation);

/// What the colours mean; one for all frames of a film.
struct View {
  ColourBy colour_by = ColourBy::kFraction;
  double end = 1.0;  ///< of the colour scale
};

/// phi_max, or the greatest speed of all frames.
View fit_view(const Scene& scene, std::span<const Frame> frames, ColourBy colour_by);

/// An SVG picture: the whole grid with walls, barriers and bodies, particles coloured (viridis,
/// which colour-blind readers can read), far ones first in 3D, a scale and a caption. Depends on
/// nothing outside the file.
std::string draw_svg(const Scene& scene, const Frame& frame, const View& view);

}  // namespace conebench::mpm
