#pragma once

#include "problems/engine/step_solver.h"

namespace conebench::engine {

/// Solves each connected component of a step's problem by itself with `solver`, so that a hard heap
/// does not make a bouncing grain wait, nor the other way round. The answer has converged where all
/// have; it carries the first other status, and the sums of iterations and seconds.
///
/// eta of the whole is the largest of the parts', since they are measured against one rate scale.
/// Cost beyond the solver's: one pass to find the components, and a copy where there are several.
StepSolver by_islands(StepSolver solver);

}  // namespace conebench::engine
