#pragma once

#include <string>

#include "dem/step.h"

namespace conebench::harness {

/// A solver of ours as the engines take it: stops on eta <= tol (common test), or after
/// `time_limit_s` of solver time a step. Throws problems::InputError for an unknown variant, and at
/// the first step that the solver cannot take.
dem::StepSolver make_step_solver(const std::string& variant, double tol, double time_limit_s);

}  // namespace conebench::harness
