#pragma once

#include <vector>

#include "dem/convex.h"
#include "dem/narrow_phase.h"

namespace conebench::dem {

/// Appends the touches with gap < reach of two sides of placed pieces that are square to `normal`
/// and all but parallel: at the ends of what they share, each with its own normal and gap. Sides
/// are those of polyhedra, capsules and cylinders. Parallel: to 0.1 rad where both pieces are round
/// about their sides, so that an end that comes down during a step is listed before it does;
/// otherwise to 1e-6.
void add_parallel_sides(const Placed& first, const Placed& second, const Eigen::Vector3d& normal,
                        double reach, std::vector<Touch>& out);

}  // namespace conebench::dem
