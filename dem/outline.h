#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "dem/convex.h"

namespace conebench::dem {

/// What is not a triangle's own in a mesh: corners and sides (k from corner k to the next) where
/// the surface goes on flat or upwards.
struct Inner {
  std::array<bool, 3> corners{};
  std::array<bool, 3> sides{};
};

/// A flat side of a piece that faces another: a polygon, a disc, a segment or a point. Coordinates
/// are x, y and the height z along the direction in which the two are looked at.
struct Outline {
  std::vector<Eigen::Vector3d> corners;              ///< of a disc four points on its rim
  std::vector<bool> inner_corners;                   ///< give no touches
  std::vector<bool> inner_sides;                     ///< from each corner to the next
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< of the polygon or disc
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();  ///< of the disc
  double disc = 0.0;

  bool flat() const { return corners.size() > 2; }
  std::size_t side_count() const;

  /// The height of the flat at a place.
  double height(const Eigen::Vector2d& at) const;

  /// Whether a place lies in the flat, or no farther than `tolerance` outside.
  bool holds(const Eigen::Vector2d& at, double tolerance) const;
};

/// The face of a piece, or its side or point, that faces along `outward`; `face` < 0: the one that
/// faces it best among those at the support. `frame`: x, y and z as columns. A disc's four points
/// begin with the highest; where they are as high, along `towards`, or, if that is zero, along the
/// piece's own x.
void set_outline(const Placed& placed, const Eigen::Vector3d& outward, int face,
                 const Eigen::Vector3d& towards, const Inner* inner, const Eigen::Matrix3d& frame,
                 Outline& outline);

/// A place of both of two outlines, with the heights there.
struct SharedPoint {
  Eigen::Vector2d at;
  double first = 0.0, second = 0.0;
};

/// Appends the corners of what two outlines have in common. Places within `tolerance` of a side are
/// on it. Cost: corners x sides.
void shared_points(const Outline& first, const Outline& second, double tolerance,
                   std::vector<SharedPoint>& out);

}  // namespace conebench::dem
