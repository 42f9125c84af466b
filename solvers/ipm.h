#pragma once

#include "solvers/iteration.h"

namespace conebench::solvers {

/// `ipm`: the interior point of solvers/interior_point.h with the De Saxce term as an unknown. No
/// convergence proof: the problem is not convex. For theta = 0 it is the convex method.
///
/// Start   at the guess.
/// Sweeps  its iterates balance forces everywhere and smooth the law of every cone; a few sweeps of
///         Gauss-Seidel (solvers/gs.h) sharpen the law: eta falls by about ten, and a third of the
///         iterations are saved. They are done for 15 % of an iteration's work whenever eta has
///         fallen to a quarter, and 20 or 40 from every iterate within 20 times `tol`; many more
///         lead away again on hard problems. The interior point goes on from its own iterate. No
///         sweeps where they would have to form W.
/// Traps   where the gap does not halve in 5 iterations (a fold of the path, or a false end: gap
///         closed, eta not small), or a factorisation fails, it begins again from r = 0 and further
///         inside; then with ten times the smoothing; then, or near rounding, it goes on as
///         aclm-ipm from its best iterate. The notes say so.
///
/// Best iterate kept, the guess included. Own test (StopTest::kOwn)  eta from its own r and u.
Method interior_point();
/// `tol`: the eta that it is asked for; 0 where there is none.
std::unique_ptr<Iteration> make_ipm(const problems::Problem& problem, double tol);

/// `aclm-ipm`: the interior point for a given shift, inside the fixed point of solvers/aclm.h.
Method aclm_interior_point();

}  // namespace conebench::solvers
