#pragma once

#include <Eigen/Core>
#include <optional>

#include "dem/convex.h"

namespace conebench::dem {

/// The nearest points of two cores.
struct NearestPoints {
  Eigen::Vector3d on_first = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_second = Eigen::Vector3d::Zero();
};

/// Of two placed cores, the first moved by `shift`; none where they then overlap or touch (to 1e-14
/// of the farthest point).
///
/// Gilbert, Johnson and Keerthi: the point nearest to the origin of a simplex in the difference of
/// the two, which takes in the support against it until none is nearer. Ends where upper and lower
/// bound of the distance meet to rounding, or the distance falls no more.
///
/// Cost    a support of each an iteration; some 5 of them for polyhedra, 20 for cylinders.
/// Source  Gilbert, Johnson, Keerthi, IEEE J. Robotics and Automation 4(2), 1988 (not checked).
///         Differs: every corner, side and face of the simplex is looked at, so that none is lost
///         to rounding.
std::optional<NearestPoints> nearest_points(const Placed& first, const Placed& second,
                                            const Eigen::Vector3d& shift);

}  // namespace conebench::dem
