#pragma once

#include "problems/problem.h"

namespace conebench::solvers {

/// A problem without units, for libraries with absolute tolerances. With
/// s = U / (100 sqrt(max lambda)),
///
///   r_i = s / sqrt(lambda_i) rbar_i,  u_i = s sqrt(lambda_i) ubar_i,  v_k = s / sqrt(M_kk) vbar_k
///
/// keep W symmetric (its diagonal blocks get norm 1) and cones as they are, and bound eta by the
/// scaled residuals: eta_i = sqrt(lambda_i / max lambda) |zbar_i| / 100. U counts as 100 because a
/// barrier method leaves |zbar_i| = sqrt(barrier) where r_i = u_i = 0, and its barrier parameter
/// cannot fall far below 1e-14.
struct Dimensionless {
  static constexpr double kRateScale = 100.0;  ///< U in units of ubar where lambda is largest

  Eigen::VectorXd force, rate;  ///< units of rbar and ubar, one entry a row
  Eigen::VectorXd velocity;     ///< unit of vbar, one entry a dof; empty in the reduced form
  double energy = 1.0;          ///< s^2: unit of r.u and v.Mv

  problems::SparseMatrix M, H;  ///< primal form, scaled
  Eigen::VectorXd f, w;         ///< primal form, scaled
  problems::SparseMatrix W;     ///< reduced form, scaled, as given (perhaps not symmetric)
  Eigen::VectorXd q;            ///< reduced form, scaled

  explicit Dimensionless(const problems::Problem& problem);
};

}  // namespace conebench::solvers
