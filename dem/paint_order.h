#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <span>
#include <vector>

namespace conebench::dem {

/// A convex polygon in a picture, anticlockwise as one sees it [px, y downwards].
using Contour = std::vector<Eigen::Vector2d>;

/// The part of `contour` that lies in `window`, convex too; empty where there is none.
Contour clipped(Contour contour, const Contour& window);

double area(const Contour& contour);  ///< [px2]

/// What a thing covers of a picture, and how deep it lies there.
struct Patch {
  Contour contour;
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();  ///< of its plane
  double farthest = 0.0, nearest = 0.0;             ///< ends of its depth [px]

  bool is_level() const { return farthest == nearest; }
  /// Of its plane, towards the eye [px].
  double plane_depth(const Eigen::Vector2d& at) const {
    return slope[0] * at[0] + slope[1] * at[1] + slope[2];
  }
  /// Whether its plane lies between the eye and a place.
  bool is_before(const Eigen::Vector3d& place) const {
    return plane_depth(place.head<2>()) > place[2];
  }
  double depth(const Eigen::Vector2d& at) const {
    return std::clamp(plane_depth(at), farthest, nearest);
  }
};

/// The order in which to paint things so that each hides what is behind it: of two that cover the
/// same place, the deeper one comes first. The same on every machine. Exact for things that do not
/// pass through each other, unless they hide each other in a ring: that is cut at its farthest.
///
/// Cost: sorting, and a comparison for every two that are not level and whose boxes overlap.
std::vector<int> paint_order(std::span<const Patch> patches);

}  // namespace conebench::dem
