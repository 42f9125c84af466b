#pragma once

#include <vector>

#include "dem/shape.h"

namespace conebench::dem {

/// A shape made ready: in the frame of its centre of mass and principal axes. A shape with a mesh
/// has no mass, and keeps its own frame.
struct Solid {
  std::vector<Part> parts;  ///< piece to body
  std::vector<int> pieces;  ///< of each part: its index among all pieces of a scene
  Pose from_shape;          ///< shape's frame to body's frame
  double volume_m3 = 0.0;
  Eigen::Vector3d moments_m5 = Eigen::Vector3d::Zero();  ///< about the axes, density 1 kg/m3
  double size_m = 0.0;  ///< half the longest side of the box about it
  /// Half the shortest side of that box; infinite with a mesh, which may be flat.
  double thinness_m = 0.0;
};

/// Appends the shape's pieces to `pieces`. Cost: a hull's is n log n.
Solid make_solid(const Shape& shape, std::vector<Piece>& pieces);

}  // namespace conebench::dem
