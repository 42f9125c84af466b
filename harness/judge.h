#pragma once

#include "problems/problem.h"
#include "results/record.h"
#include "solvers/solver.h"

namespace conebench::harness {

/// Writes into `record` what the answer is worth: residuals of r' and the final status. A claim of
/// success above the tolerance is refuted. A model is judged twice: by eta in the problem as posed,
/// its gap, and by model_eta in its own (solvers/model_residual.h), which is what its claim is
/// about. An r' of the wrong length or with a NaN is no answer. r' may be empty where the solver
/// says that it cannot answer. A claim that there is no solution is refuted, again except a
/// model's, unless its certificate proves it (solvers/certificate.h).
void judge(const problems::Problem& standard, const solvers::Result& result,
           results::Record& record);

}  // namespace conebench::harness
