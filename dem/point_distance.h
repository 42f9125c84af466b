#pragma once

#include <Eigen/Core>

#include "dem/convex.h"

namespace conebench::dem {

/// How far a point is from a piece's surface; exact, in closed form.
struct PointDistance {
  double distance = 0.0;                              ///< < 0: inside
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< from the nearest point, unit length
};

/// `point` from the piece's centre, in the piece's directions. Inside, the nearest way out counts;
/// of several the first. Cost: a polyhedron's faces, and the sides of those that the point sees.
PointDistance point_distance(const Convex& convex, const Eigen::Vector3d& point);

/// The point of a triangle that is nearest to `point`, and the corners that it lies between.
struct TrianglePoint {
  Eigen::Vector3d nearest;
  int corners = 0;  ///< bit k: corner k has a share
};
TrianglePoint nearest_in_triangle(const Eigen::Vector3d& point, const Eigen::Vector3d& a,
                                  const Eigen::Vector3d& b, const Eigen::Vector3d& c);

}  // namespace conebench::dem
