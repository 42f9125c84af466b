#pragma once

#include "solvers/convex.h"

namespace conebench::solvers {

/// Semismooth Newton on the augmented Lagrangian of the convex problem (solvers/convex.h).
///
/// With multipliers c and penalties sigma_i = 1 / (alpha lambda_i), the proximal step from c solves
///
///   r = P_K( c - sigma (u(r) + t e_n) ),   u(r) = W r + q,
///
/// which is the minimum of the convex, once differentiable
///   phi(r) = 1/2 r.W r + sum_i alpha lambda_i / 2 |P_K(c_i - sigma_i (u_i + t_i e_n))|^2,
/// whose derivative along dr is (r - P).W dr. A Newton step solves (I + E W) dr = P - r with
/// E_i = sigma_i dP_K, symmetric positive semidefinite: one Cholesky (linear/normal_system.h). The
/// step length comes from the derivative of phi alone, which does not cancel near the solution.
/// dP_K is I in K and on its boundary, 0 in the polar cone and on its boundary.
///
/// Once a proximal step is solved well enough, c <- P. alpha falls tenfold, 1e-3 to 1e-8, while
/// steps are easy, and grows where a factorisation fails. Convergence to the convex problem's
/// solution is that of the proximal point method; finite termination is not claimed.
/// Source  Rockafellar, Math. Oper. Res. 1(2) (1976) 97-116; Zhao, Sun, Toh, SIAM J. Optim. 20(4)
///         (2010) 1737-1765 (neither checked). The reduced form and the step length are ours.
std::unique_ptr<ConvexIteration> make_ssnal(const problems::Problem& problem);

}  // namespace conebench::solvers
