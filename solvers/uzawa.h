#pragma once

#include "solvers/iteration.h"

namespace conebench::solvers {

/// Uzawa's algorithm on De Saxce's bipotential: every contact predicts along its own u_hat and is
/// corrected by the projection on its cone, all at once, then u follows,
///
///   r_i <- P_K( r_i - rho_i (u_i + theta_i |u_it| e_n) ),   u = W r + q,
///
/// with rho_i = rho / lambda_i. A step is taken back, and rho shortened, until
/// rho |u_hat(r+) - u_hat(r)| <= 1.2 |r+ - r| (norms of 1/lambda and lambda; the convex problem
/// asks for less than 2), and rho grows by a fifth after a step where 0.9 would have done.
///
/// One contact after another, each with the newest u: gs[local=projection], with rho = 1.
///
/// Cost    one product with W an iteration, and one for each step taken back.
/// Own test (StopTest::kOwn)  eta from its own r and u_hat.
/// No convergence proof for friction; for theta = 0 it is projected gradient descent on the dual.
/// Source  De Saxce, Feng, Int. J. Mech. Struct. Mach. 19(3) (1991); Math. Comput. Modelling 28
///         (1998); Joli, Feng, Int. J. Numer. Meth. Engng 73 (2008) 317-330. The test on rho is
///         that of fixed points of variational inequalities: Khobotov, USSR Comput. Math. Math.
///         Phys. 27 (1987), without its second projection (none checked).
Method uzawa();

}  // namespace conebench::solvers
