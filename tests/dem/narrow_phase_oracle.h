#pragma once

#include <array>
#include <vector>

#include "dem/narrow_phase.h"

namespace conebench::dem::test {

/// The point of a convex piece farthest along a direction.
Eigen::Vector3d support(const Piece& piece, const Pose& pose, const Eigen::Vector3d& direction);

/// The least of the first along a unit vector less the most of the second: never more than their
/// distance.
double separation(const Piece& first, const Pose& first_pose, const Piece& second,
                  const Pose& second_pose, const Eigen::Vector3d& normal);

/// Whether a point is in a convex piece, or no farther than `tolerance` outside.
bool holds(const Piece& piece, const Pose& pose, const Eigen::Vector3d& point, double tolerance);

/// A box or hull as a bag of triangles in the world.
using Triangles = std::vector<std::array<Eigen::Vector3d, 3>>;
Triangles triangles_of(const Piece& piece, const Pose& pose);

/// The distance of two disjoint polyhedra: the least over all corners with all triangles, and all
/// sides with all sides.
double distance_of(const Triangles& first, const Triangles& second);
double distance_of(const Eigen::Vector3d& point, const Triangles& triangles);

/// The greatest separation along the normals of all triangles and the products of all sides: of
/// polyhedra that overlap less their overlap.
double greatest_separation(const Triangles& first, const Triangles& second);

double segment_distance(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                        const Eigen::Vector3d& c, const Eigen::Vector3d& d);

}  // namespace conebench::dem::test
