#pragma once

#include "solvers/registry.h"

namespace conebench::solvers {

/// Proximal point method on the Coulomb problem itself. From a centre c, an inner method goes for
/// the r of the problem with W + alpha lambda for W and q - alpha lambda c for q,
///
///   u_c = W r + q + alpha lambda (r - c),   K_mu* contains u_c + theta |u_ct| e_n,
///   orthogonal to r in K_mu,
///
/// whose own eta (with lambda, U of the problem as posed) is F. Its fixed points c = r solve the
/// problem; a solved step leaves eta near D = max_i alpha lambda_i |r_i - c_i| / U.
///
/// Inner    ac, fb: semismooth Newton with c held (solvers/newton/proximal_equation.h). gs:
///          Gauss-Seidel, ten sweeps an iteration. Each starts at c.
/// Inexact  a step is solved when F <= accuracy D: the tolerance follows the progress.
/// Weight   alpha falls fivefold after a step of at most 4 inner iterations, to a half after one of
///          at most 12. Where the inner method breaks down, or 40 iterations were not enough, alpha
///          grows fourfold and the best iterate (of least eta) is the next centre.
/// Stalls   when that has happened 8 times in a row.
/// One iteration is one of the inner method.
/// Own test (StopTest::kOwn)  eta from the inner method's r and u.
/// No convergence proof for friction: the operator is not monotone.
/// Source   Rockafellar, SIAM J. Control Optim. 14(5) (1976), criterion (B); PPA-NSN of RR-9118
///          (2017) (neither checked). The weight's rules are ours.
Method proximal_point();

}  // namespace conebench::solvers
