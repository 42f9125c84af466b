#pragma once

#include <span>
#include <string>
#include <vector>

#include "dem/placement.h"
#include "problems/engine/svg.h"

namespace conebench::dem {

/// One moment of a simulation.
struct Frame {
  double time_s = 0.0;
  Bodies bodies;
};

/// Where the eye is and what the colours mean; one view for all frames of a film.
struct View : engine::Window {
  double fastest_m_s = 1.0;                          ///< speed at the end of the colour scale
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  ///< of the free bodies, over all frames [m]
  std::vector<bool> glass;  ///< of each body: its parts before `middle` are seen through
};

/// A view of one frame or more, along engine::oblique_axes(), or engine::level_axes() in two
/// dimensions. It holds the free bodies of all frames, and fixed and driven solids unless they are
/// much larger. It is wide, so that columns of one height are drawn to one scale unless they spread
/// far. Fixed and driven solids that hide a free body in any frame, as the near wall of a drum
/// does, are glass.
View fit_view(const Scene& scene, std::span<const Solid> solids, std::span<const Frame> frames);

/// An SVG picture: bodies coloured by speed (viridis, which colour-blind readers can read), fixed
/// and driven ones in grey, with shadows on the floors, a scale and a caption. Floors are planes
/// that face upwards; walls are not drawn. In two dimensions, what is behind a plane is filled.
/// `start` gives solids and planes; its bodies are not looked at. Depends on nothing outside the
/// file.
std::string draw_svg(const Scene& scene, const Placement& start, const Frame& frame,
                     const View& view);

}  // namespace conebench::dem
