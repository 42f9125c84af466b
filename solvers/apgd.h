#pragma once

#include "solvers/iteration.h"

namespace conebench::solvers {

/// Accelerated projected gradient descent: Nesterov's momentum on the dual, restarted where it goes
/// uphill, the De Saxce term refreshed as it goes.
///
/// For fixed t = theta |u_t| the convex problem  min r.W r / 2 + (q + t e_n).r  over the cones has
/// gradient u_hat = u + t e_n. In the metric lambda_i per cone, from y, which runs ahead of r:
///
///   r+ = P_K(y - u_hat(y) / (L lambda)),   y <- r+ + beta (r+ - r),
///
/// t from u(y), every `refresh` iterations. L doubles until d.W d <= L |d|^2_lambda for
/// d = r+ - y, which is what a step of 1/L needs, and shrinks by 2 % an iteration. beta comes from
/// Nesterov's sequence, which starts anew (beta = 0) when the way gone, r+ - r, has an obtuse angle
/// with the step, r+ - y. u(y) follows from u at the last two r, so that a trial costs one product.
///
/// Where M is block diagonal or W is given, cones that have no reaction, and would have none after
/// a step, are left out, all products of theirs included, if they are a quarter of all: for an
/// eighth of the iterations so far, 10 at least, `skip` at most. Then all are looked at again; a
/// cone that wakes has its rate at r for that at y in its first step.
///
/// Cost    one product with W an iteration, and one for each time that L doubles (1 in 35 at rest);
///         of the cones that are awake.
/// Memory  that of DelassusProduct, and 9 numbers a row.
/// Own test (StopTest::kOwn)  eta from its own r and u, of the cones that are awake.
/// No convergence proof with refresh; for theta = 0 a convex problem, |f - f*| = O(1/k^2).
/// Source  Mazhar, Heyn, Negrut, Tasora, ACM Trans. Graph. 34(3) (2015), Algorithm 1, which solves
///         the associated problem (t = 0) with L of a random start and a shrinking of 10 %;
///         restart: O'Donoghue, Candes, Found. Comput. Math. 15 (2015) (neither checked).
Method apgd();
std::unique_ptr<Iteration> make_apgd(const problems::Problem& problem);

}  // namespace conebench::solvers
