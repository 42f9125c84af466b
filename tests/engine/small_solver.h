#pragma once

#include "problems/engine/step_solver.h"

namespace conebench::test {

/// A step solver that shares no code with solvers/: Gauss-Seidel on the dense W, for each cone the
/// normal reaction first, then the tangential one projected on the ball of radius mu r_n (no De
/// Saxce shift, no cone projection, own stopping test). For a few contacts or cells.
/// `tol` is on the largest change of a sweep, as a rate, relative to max |q|.
engine::StepSolver small_solver(double tol = 1e-14);

}  // namespace conebench::test
