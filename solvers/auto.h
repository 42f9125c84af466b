#pragma once

#include "solvers/iteration.h"

namespace conebench::solvers {

/// `auto`: Gauss-Seidel, proximal Alart-Curnier Newton, the fixed point aclm and the interior point
/// take turns on one problem, each for as long as it promises to be the first to finish.
///
/// Lanes     gs, newton-ac, aclm, ipm, with their defaults; each is made when its first turn comes
///           and keeps its factorisations.
/// Turn      lasts until the lane has used half as much time again as before it (at least one
///           iteration; the first one of gs: 30 sweeps). Then eta of its iterate is computed,
///           inside the clock.
/// Promise   a lane whose last turn of t seconds took ln(eta) down by g finishes in about
///           t ln(eta / tol) / g. A lane that has not run promises what a step of it is expected to
///           cost, in sweeps of gs, times the steps it usually needs. A lane whose turn brought
///           nothing promises 4 times the time it has had, so that all lanes stay within a constant
///           factor of each other where none makes progress.
/// Choice    the least promise takes the next turn. It starts from the best iterate of all lanes
///           where that is ten times better than its own (the interior point excepted, which
///           gains nothing from a start on the boundary).
///
/// Evidence: on hyperstatic piles Gauss-Seidel crawls where Newton with a proximal term finishes in
/// a few steps, on sphere packings the other way round, and nothing in the data tells them apart
/// beforehand; progress does. The whole time is at most (lanes + 1) times that of the best lane,
/// up to the growth of turns.
/// Own test (StopTest::kOwn)  that of the lane, verified with eta.
Method automatic();

std::unique_ptr<Iteration> make_automatic(const problems::Problem& problem, double tol);

}  // namespace conebench::solvers
