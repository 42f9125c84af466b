#pragma once

#include "solvers/iteration.h"

namespace conebench::solvers {

/// `ipm`: the interior point of solvers/interior_point.h with the De Saxce term as an unknown. No
/// convergence proof: the problem is not convex. For theta = 0 it is the convex method. It starts
/// from r = 0, whatever the guess, which counts as its first iterate. The best iterate is kept.
/// Where the gap does not halve in 5 iterations (a fold of the path, or the trap of false
/// convergence: gap closed, eta not small), or a factorisation fails, it begins again with ten
/// times the smoothing; trapped again, or near rounding, it goes on as aclm-ipm from its best
/// iterate. The notes say so. Own test (StopTest::kOwn)  eta from its own r and u.
Method interior_point();
std::unique_ptr<Iteration> make_ipm(const problems::Problem& problem);

/// `aclm-ipm`: the interior point for a given shift, inside the fixed point of solvers/aclm.h.
Method aclm_interior_point();

}  // namespace conebench::solvers
