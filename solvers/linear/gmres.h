#pragma once

#include <Eigen/Core>
#include <functional>

namespace conebench::solvers {

/// What gmres() found.
struct KrylovAnswer {
  Eigen::VectorXd x;
  int iterations = 0;  ///< products with the matrix
};

/// Solves A x = b from x = 0 by GMRES without restarts, until |b - A x| <= share |b| or `most`
/// products are made. x = 0 for b = 0 and for a b that is not finite. `apply` is A.
///
/// Cost    `most` + 1 vectors; an iteration k one product and 2 k scalar products.
/// Source  Saad, Schultz, SIAM J. Sci. Stat. Comput. 7(3) (1986) 856-869 (not checked).
KrylovAnswer gmres(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
                   const Eigen::VectorXd& b, double share, int most);

}  // namespace conebench::solvers
