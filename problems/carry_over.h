#pragma once

#include "problems/problem_file.h"

namespace conebench::problems {

/// The answer r' of one step as a guess for a later step of the same scene: [force_unit of `to`]
///
/// Cones are matched by their pair of bodies and, within a pair, by the nearest point, each at most
/// once; nodes of a medium by their position, which does not move. A cone of a contact that is new
/// starts from 0. Reactions at contacts turn with the frames; those of a medium's nodes have axes
/// of their own. Impulses grow with the step, so r' is scaled by the ratio of the step sizes where
/// both are known. The result lies in the cones of `to`.
///
/// Without geometry in both files cones are matched by their order where the dimensions of all
/// agree; else the guess is 0.
///
/// Cost  O(n log n) and, for a pair of bodies with k contacts, O(k^2).
Eigen::VectorXd carry_over(const ProblemFile& from, const Eigen::VectorXd& r,
                           const ProblemFile& to);

}  // namespace conebench::problems
