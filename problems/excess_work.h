#pragma once

#include "problems/problem.h"

namespace conebench::problems {

/// The work of the reactions beyond what their law gives them, sum over the cones of r'_i . u_hat_i
/// [force_unit rate_unit]: 0 at a solution, where a reaction only does the work of friction. What
/// an answer that is not quite one puts into the motion (> 0) or takes from it; its sign is kept,
/// unlike that of Residual::work.
///
/// Cost: one product with W. Same preconditions as evaluate_residual().
double excess_work(const Problem& standard, const Eigen::VectorXd& r);

}  // namespace conebench::problems
