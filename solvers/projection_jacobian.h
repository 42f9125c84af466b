#pragma once

#include "solvers/block_diagonal.h"

namespace conebench::solvers {

/// x <- P_K(x) on the cone of friction mu, J <- an element of the projection's generalised Jacobian
/// there: I in K and on its boundary, 0 in the polar cone and on its boundary. J is symmetric with
/// eigenvalues in [0, 1]. x has d entries, normal first; J is d x d.
void project_with_jacobian(double mu, Eigen::Ref<Eigen::VectorXd> x, BlockDiagonal::Block J);

}  // namespace conebench::solvers
