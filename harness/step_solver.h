#pragma once

#include "problems/engine/step_solver.h"

namespace conebench::harness {

/// A solver of ours as the engines take it: stops on eta <= tol (common test), or after
/// `time_limit_s` of solver time or `max_iterations` a step; or, by the name "policy:FILE", a
/// ladder of them with its own tolerance and time limits (harness/policy.h). Throws
/// problems::InputError for an unknown variant, and at the first step that the solver cannot take.
engine::StepSolver make_step_solver(const engine::SolverChoice& choice);

}  // namespace conebench::harness
