#pragma once

#include "solvers/registry.h"

namespace conebench::solvers {

/// `pyramid`, a model: the friction cones replaced by pyramids of `faces` faces inside them
/// (solvers/pyramid_law.h), any 0 <= theta <= mu. Exact where every d <= 2 or mu = 0.
///
/// method = lemke  the linear complementarity problem of solvers/pyramid_lcp.h by pivots
///                 (solvers/lemke.h). Refuses problems of more than 4000 variables (faces + 2 a
///                 cone of d = 3): its table is dense, 8 bytes a square. Where it ends on a ray, or
///                 rounding left the answer short of the tolerance, it says so and is stalled.
/// method = pgs    projected Gauss-Seidel: for each cone in turn
///                 r_i <- P_K(r_i - u_hat_i / lambda_i), K and u_hat of the pyramid.
/// Converged means eta of the model (PyramidLaw::eta) <= tol, looked at inside the clock: at the
/// end of lemke, every ten sweeps of pgs. Iterations are pivots, or sweeps. The answer's eta in the
/// problem as posed is the model's gap.
/// Refuses cones of d > 3, and W = 0.
Method pyramid_model();

}  // namespace conebench::solvers
