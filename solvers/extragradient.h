#pragma once

#include "solvers/iteration.h"

namespace conebench::solvers {

/// Extragradient on the Coulomb problem itself, a variational inequality whose map
///
///   F(r) = u_hat(r) = W r + q + theta |u_t(r)| e_n
///
/// is no gradient where theta > 0: nothing is frozen, nothing refreshed. In the metric lambda_i per
/// cone, with d = lambda (r - p) - tau (F(r) - F(p)):
///
///   p  = P_K(r - tau F(r) / lambda)                                prediction
///   r <- P_K(r - gamma s tau F(p) / lambda),  s = (r - p).d / |d|^2_{1/lambda}    correction
///
/// tau: the prediction is repeated with tau shortened until tau |F(r) - F(p)| <= 0.9 |r - p| (norms
/// of 1/lambda and lambda); tau grows by half after a step where 0.3 would have done, and r - p
/// could be measured. step = unit is Korpelevich's correction, gamma s = 1; step = optimal,
/// gamma = 1.8, goes further along the same direction wherever F is monotone.
///
/// Cost    two products with W an iteration, and one for each prediction repeated.
/// Accuracy  where r - p is too small beside r to be measured, tau stays and the correction is
///         Korpelevich's: s is made of differences, and their rounding would stop at an eta of 1e-7
///         with reactions a million times the rates' size.
///
/// Own test (StopTest::kOwn)  eta from its own r and F(r).
/// Converges where F is monotone (theta = 0); friction makes F neither monotone nor
/// pseudo-monotone, so that nothing is promised.
/// Source  Korpelevich, Matekon 13 (1977); tau: Khobotov, USSR Comput. Math. Math. Phys. 27 (1987),
///         Marcotte, INFOR 29 (1991); s: He, Liao, J. Optim. Theory Appl. 112 (2002) (none
///         checked).
Method extragradient();

}  // namespace conebench::solvers
