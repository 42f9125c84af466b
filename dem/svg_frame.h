#pragma once

#include <span>
#include <string>
#include <vector>

#include "dem/scene.h"
#include "dem/spheres.h"
#include "problems/engine/svg.h"

namespace conebench::dem {

/// One moment of a simulation, as much of it as a picture needs.
struct Frame {
  double time_s = 0.0;
  std::vector<Eigen::Vector3d> positions;  ///< [m]
  std::vector<double> radii;               ///< [m]
  std::vector<double> speeds;              ///< [m/s]
  std::vector<bool> fixed;                 ///< drawn in grey, and outside the window if need be
};

Frame make_frame(const Spheres& spheres, double time_s);

/// Where the eye is and what the colours mean; one view for all frames of a film.
struct View : engine::Window {
  double fastest_m_s = 1.0;  ///< speed at the end of the colour scale
};

/// A view that holds all frames, along engine::oblique_axes(). It is wide, so that columns of one
/// height are drawn to one scale unless they spread far.
View fit_view(const Scene& scene, std::span<const Frame> frames);

/// An SVG picture: the spheres as shaded discs, far ones first, coloured by speed (viridis, which
/// colour-blind readers can read), with shadows on the floors, a scale and a caption. Floors are
/// the scene's planes that face upwards; walls are not drawn. Depends on nothing outside the file.
std::string draw_svg(const Scene& scene, const Frame& frame, const View& view);

}  // namespace conebench::dem
