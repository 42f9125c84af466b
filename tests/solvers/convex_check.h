#pragma once

#include <random>

#include "problems/made_backwards.h"
#include "solvers/convex.h"

namespace conebench::solvers {

/// Poses the convex problem with this shift at r = 0, advances at most `runs` times towards `tol`
/// and returns its error, recomputed from r alone.
inline double solved_to(const problems::Problem& problem, const Eigen::VectorXd& shift,
                        ConvexIteration& convex, double tol, int runs) {
  convex.pose(shift, Eigen::VectorXd::Zero(problem.rows()));
  for (int run = 0; run < runs && convex.error() > tol; ++run) convex.advance(tol);
  return convex_error(problem, shift, convex.r(), problem.rate(convex.r()));
}

/// t_i between 0 and U, one a cone.
inline Eigen::VectorXd random_shift(const problems::Problem& problem) {
  std::mt19937_64 random(5);
  Eigen::VectorXd shift(problem.cone_count());
  for (double& t : shift) {
    t = problem.rate_scale() * static_cast<double>(random() >> 11) * 0x1p-53;
  }
  return shift;
}

}  // namespace conebench::solvers
