#pragma once

#include "solvers/method.h"

namespace conebench::solvers {

/// `auto`: accelerated projected gradient, Gauss-Seidel, ADMM, Newton on the proximal point problem
/// (solvers/prox_newton.h), proximal Alart-Curnier Newton, the interior point and the fixed point
/// aclm take turns on one problem, each for as long as it promises to be the first to finish.
///
/// Lanes     apgd, gs[skip=10], admm (for tol >= 1e-4, not on grids), prox-newton, newton-ac, ipm,
///           aclm; each is made when its first turn comes and keeps its factorisations. One that
///           refuses the problem is left out; a problem that all refuse is refused.
/// Clock     the work counted by Iteration::work_s, not time: the same problem from the same guess
///           takes the same turns in every run.
/// Turn      lasts until the lane has done half as much work again as before it (at least one
///           iteration; the first one of apgd 100, of gs 30, of admm 10). Then eta of its iterate
///           is computed, inside the clock.
/// Promise   a lane whose last turn of work t took ln(eta) down by g finishes within about
///           t ln(eta / tol) / g. One whose turn brought nothing promises twice what its whole
///           record promises by the same rule, 1 to 4 times the work done, 4 where its eta has
///           risen to 4 times its least, so that lanes without progress stay within a constant
///           factor of each other. Before it has done the steps it usually needs (apgd 1000, of at
///           most 60 cones 500, on grids 300, in the plane 150 to an eta of 1e-5; admm 300,
///           prox-newton 80, newton-ac 60, ipm 30, on grids 15, in the plane 20, there 6 for tol >=
///           1e-4, aclm 60), a lane promises at most the work of the rest; before its first turn, a
///           number of sweeps of gs, larger for the last three where H has more rows than columns,
///           so that W is singular, and smaller for newton-ac where cones are at most 60. The lane
///           that promises least begins: apgd. Where rows of H have more than 12 entries on
///           average, so that cones are nodes of a grid, prox-newton and ipm are next, in the plane
///           (no cone of d > 3) ipm alone, and all the others long after them; for tol >= 1e-4 gs,
///           from the guess, then prox-newton and ipm alike, in space ipm after it. In the plane
///           what apgd promises above an eta of 1e-3, which it reaches quickly even where it never
///           gets further, counts fivefold.
/// Choice    the least promise takes the next turn. It starts again from the best iterate of all
///           lanes where that is 10 times better than its own (gs, prox-newton, aclm); never
///           newton-ac, whose path matters, ipm, which begins far inside the cones whatever the
///           guess, and apgd and admm, which would lose their momentum and their rho. A lane that
///           stopped goes on only in this way.
///
/// Evidence (results/published/auto.md): on hyperstatic piles Gauss-Seidel and apgd crawl where
/// Newton with a proximal term finishes in some steps, on sphere packings the other way round, and
/// nothing in the data tells them apart beforehand; progress does. apgd is the quickest of our
/// methods on most problems of both engines, so that it begins; where it is not, the interior point
/// on grids, a Newton method on others, and at loose tolerances the sweeps, are. Aims at a small
/// multiple of the best lane's time; there is no proof. Own test (StopTest::kOwn) that of the lane,
/// verified with eta.
Method automatic();

}  // namespace conebench::solvers
