#pragma once

#include "solvers/iteration.h"

namespace conebench::solvers {

/// `ipm`: the interior point of solvers/interior_point.h with the De Saxce term as an unknown. No
/// convergence proof: the problem is not convex. For theta = 0 it is the convex method. The best
/// iterate is kept. Where gap and eta stop falling (the trap of false convergence: gap closed, eta
/// not small), or a factorisation fails, it goes on as aclm-ipm from its best iterate and says so;
/// the last smoothing is in the notes.
/// Own test (StopTest::kOwn)  eta from its own r and u.
Method interior_point();
std::unique_ptr<Iteration> make_ipm(const problems::Problem& problem);

/// `aclm-ipm`: the interior point for a given shift, inside the fixed point of solvers/aclm.h.
Method aclm_interior_point();

}  // namespace conebench::solvers
