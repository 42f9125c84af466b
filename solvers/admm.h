#pragma once

#include "solvers/iteration.h"

namespace conebench::solvers {

/// Alternating direction method of multipliers, the De Saxce term refreshed in every iteration.
///
/// For fixed t = theta |u_t| the convex problem (solvers/convex.h) is split into its linear part
/// and its cones: u_hat = H v + w + t e_n and a copy z in K* of it. In the metric of lambda_i per
/// cone (what follows is in units where lambda_i = 1), the state zeta = r - rho z, r in K, z in K*,
/// r.z = 0, gives
///
///   t = theta |z_t|,   (I + rho W) x = r + rho (z - t e_n - q),   u_hat = W x + q + t e_n,
///   zeta <- r - rho (relaxation u_hat + (1 - relaxation) z),   r = P_K(zeta).
///
/// x is a copy of r as z is one of u_hat; at a fixed point they agree and r solves the Coulomb
/// problem. Primal form: x comes from one Cholesky factor of M + rho sum_i H_i^T H_i / lambda_i,
/// whatever the structure of M and the rank of W. Reduced form: from one of I + rho W, its lower
/// blocks mirrored; what that leaves of the equation is carried to the next iteration, so that
/// fixed points are those of W as given.
///
/// rho balances |u_hat - z| and rho times the change of z: multiplied by the root of their ratio
/// where that is above 2 or below 1/2. It is looked at ever more rarely, so that it comes to rest;
/// only then is there a new factor, in the same order. A factorisation that fails (a reduced W that
/// is not PSD) lowers rho for good. Anderson acceleration of zeta restarts as soon as its residual
/// grows.
///
/// Cost    one solve with the factor an iteration, O(anderson) passes over r; reduced form: and a
///         product with W.
/// Accuracy  rho multiplies the rounding in u_hat. Where |u_hat - z| is no larger than that, rho
///         stays, and r_hat - r is solved for from u(r): one product with W more an iteration.
///
/// Own test (StopTest::kOwn)  the largest entry of what rho balances, as a rate, over U.
/// No convergence proof for friction; for theta = 0, with rho at rest and without Anderson, it is
/// ADMM on a convex problem.
///
/// Source  Boyd, Parikh, Chu, Peleato, Eckstein, Found. Trends Mach. Learn. 3(1) (2011), sections
///         3.1, 3.4.1, 3.4.3; on contact: Tasora, Mangoni, Benatti, Garziera, Int. J. Numer. Meth.
///         Engng 122(16) (2021); Carpentier, Le Lidec, Montaut, arXiv:2405.17020 (none checked).
///         One state zeta and the carried residual: ours.
Method admm();
std::unique_ptr<Iteration> make_admm(const problems::Problem& problem);

}  // namespace conebench::solvers
