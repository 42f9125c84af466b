#pragma once

#include "solvers/method.h"

namespace conebench::solvers {

/// Spectral projected gradient on the dual, with the De Saxce term refreshed as it goes.
///
/// For fixed s (one s_i >= 0 a cone) the convex problem  min f_s(r) = r.W r / 2 +
/// (q + theta s e_n).r over the cones has gradient u + theta s e_n. Every `refresh` iterations s_i
/// = |u_it| is taken from the iterate, so that a fixed point solves the Coulomb problem. In the
/// metric lambda_i per cone:
///
///   d = P_K(r - alpha u_hat / lambda) - r,   r <- r + t d,
///
/// t = 1, shortened until f_s(r + t d) <= max over the last `memory` iterates of f_s + 1e-4 t
/// u_hat.d; alpha from Barzilai-Borwein: |d|^2_lambda / d.Wd (long) or d.Wd / |Wd|^2_{1/lambda}
/// (short); `step = adaptive` takes the short one when it is less than half of the long one.
///
/// f_s of earlier iterates is recomputed for the s in force (r_n of each is kept), so that the
/// comparison stays one of the same function.
///
/// Cost    one product with W an iteration (solvers/delassus_product.h).
/// Memory  8 memory + 150 bytes a cone.
/// Own test (StopTest::kOwn)  eta from its own, recursively updated u.
/// No convergence proof with refresh; for theta = 0 it is SPG on a convex problem.
/// Source  Birgin, Martinez, Raydan, SIAM J. Optim. 10(4) (2000), Algorithm SPG2 (not checked).
Method spectral_projected_gradient();

}  // namespace conebench::solvers
