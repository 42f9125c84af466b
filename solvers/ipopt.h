#pragma once

#include "solvers/method.h"

namespace conebench::solvers {

/// One shot: the whole problem as one smooth, non-convex program, given to Ipopt.
///
///   min  sum_i r_in p_i + mu_i r_in s_i + r_it.u_it     (the De Saxce gap r.u_hat)
///   over v, r, p >= 0, u_t, s   with   M v - H^T r = f,   r_i in K_mu,   |u_it| <= s_i,
///        p_i + (mu_i - theta_i) s_i = (H v + w)_in,   u_t = (H v + w)_t
///
/// (reduced form: W r + q for H v + w). p and s split u_hat = (p + mu s, u_t), which is in K_mu*
/// exactly if some p >= 0, s >= |u_t| exist. The two terms p r_n and mu r_n s + r_t.u_t of the gap
/// are >= 0 each: r solves the problem exactly where the minimum is 0. Both cones are posed as in
/// solvers/cone_program.h, with eps 1e-14 of U, and scaled by solvers/dimensionless.h; derivatives
/// are exact, the Hessian has a few entries a row. Ipopt runs to ever smaller tolerances, each
/// run started from the last; one that fails is started anew, twice, from where it ended. The gap
/// and eps are noted. One iteration is one of Ipopt's.
///
/// Cost    one sparse symmetric factorisation (MUMPS) of size 2 dofs + 3 rows + 5 cones or so an
///         iteration, W itself in the reduced form; its zero diagonals cost fill. The time limit is
///         seen between iterations only.
/// Own test (StopTest::kOwn)  Ipopt's, then eta itself, inside the clock.
/// A local minimum whose gap is not 0 ends as `stalled`; nothing proves that there is none.
Method ipopt();

}  // namespace conebench::solvers
