#pragma once

#include "problems/problem.h"
#include "results/record.h"
#include "solvers/solver.h"

namespace conebench::harness {

/// Writes into `record` what the answer is worth: residuals of r' and the final status. A claim of
/// success above the tolerance is refuted (except a model's, whose claim is about its own problem);
/// an r' of the wrong length or with a NaN is no answer. r' may be empty where the solver says that
/// it cannot answer. A claim that there is no solution is refuted, again except a model's, unless
/// its certificate proves it (solvers/certificate.h).
void judge(const problems::Problem& standard, const solvers::Result& result,
           results::Record& record);

}  // namespace conebench::harness
