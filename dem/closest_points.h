#pragma once

#include <Eigen/Core>

#include "dem/convex.h"

namespace conebench::dem {

/// Where the cores of two pieces are nearest, or, where they overlap, how they come free soonest.
struct ClosestPoints {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< from the second to the first, unit length
  double distance = 0.0;                              ///< < 0: overlap
  Eigen::Vector3d on_first = Eigen::Vector3d::Zero();
  Eigen::Vector3d on_second = Eigen::Vector3d::Zero();
};

/// How far two cores are apart along a unit vector: the least of the first less the most of the
/// second. No more than their distance, or less than zero where they overlap.
double separation(const Placed& first, const Placed& second, const Eigen::Vector3d& normal);

/// Of two placed cores of which the smaller has a size of about 1.
///
/// Apart: nearest_points(). Overlapping, or nearer than 1e-8: the best of the normals of faces and
/// of pairs of edges, exact for polyhedra. From there one goes up: with the first moved just clear
/// along the normal, the normal of the closest points separates the two no worse. Where a cylinder
/// is one of the two, refine_normal() follows; overlaps of its rim with a corner may then end at
/// another way out than the shortest, if one is about as short.
///
/// Cost    apart: some ten supports of each. Overlap: faces x points + edges x edges.
ClosestPoints closest_points(const Placed& first, const Placed& second);

}  // namespace conebench::dem
