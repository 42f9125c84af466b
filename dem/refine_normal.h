#pragma once

#include "dem/closest_points.h"

namespace conebench::dem {

/// Makes exact what is nearly the normal of closest points, where discs of cylinders are in play;
/// never worse than before.
///
/// Which sides of the cores are square to the normal is guessed in turn: none, each at the support,
/// each two. Then s(n), from the second's support to the first's, is a smooth function, and
/// Newton's method on the sphere finds where it is along n: where n . s(n), the separation, is
/// greatest. The guess that separates best is taken, with the points that belong to it; where none
/// does better, a step straight uphill. Ends where the two points are right above each other, which
/// proves the distance of pieces that are apart.
///
/// Cost: a few supports a guess. Allocates, but not where the start is exact already.
void refine_normal(const Placed& first, const Placed& second, ClosestPoints& closest);

}  // namespace conebench::dem
