#pragma once

#include "solvers/pyramid_law.h"

namespace conebench::solvers {

/// The model of solvers/pyramid_law.h as a linear complementarity problem in z >= 0. For each cone
/// z holds r_n, then, where mu > 0 and d > 1, one beta_j a direction and the sliding speed gamma:
///
///   r_t = sum_j beta_j d_j;
///   0 <= r_n     complementary to  u_n - (mu - theta) gamma  >= 0,
///   0 <= beta_j  complementary to  d_j.u_t + gamma           >= 0,
///   0 <= gamma   complementary to  mu r_n - sum_j beta_j     >= 0,
///
/// so that gamma = |-u_t|_P where r_n > 0. With r = G z in units in which |W_ii| = 1 and |q| = 1,
/// M = G^T W G + S. z.S z = theta r_n gamma >= 0, so that M is copositive for z >= 0, for theta = 0
/// and a semidefinite W positive semidefinite.
/// Source  Anitescu, Potra, Nonlinear Dyn. 14 (1997) 231-247; Stewart, Trinkle, Int. J. Numer.
/// Meth.
///         Eng. 39 (1996) 2673-2691 (neither checked); theta < mu: ours.
struct PyramidLcp {
  /// Assembles W. Precondition: !PyramidLaw::refuses(problem), mobility() > 0.
  PyramidLcp(const problems::Problem& problem, const PyramidLaw& law);

  /// How many z there are.
  static Eigen::Index size(const problems::Problem& problem, const PyramidLaw& law);

  Eigen::VectorXd reaction(const Eigen::VectorXd& z) const { return G * z; }

  problems::SparseMatrix G;  ///< rows() x size
  Eigen::MatrixXd M;
  Eigen::VectorXd q;
};

}  // namespace conebench::solvers
