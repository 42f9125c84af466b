#pragma once

#include <filesystem>
#include <vector>

#include "results/record.h"
#include "solvers/solver.h"

namespace conebench::harness {

struct CheckResult {
  results::Record record;
  /// Solved to the verified tolerance without breaking down, or openly unsupported.
  bool passed = false;
};

/// Runs a solver, each time in a worker process, on small problems made backwards from their
/// solutions (every dimension, with cohesion, rank-deficient), or on the problems in `paths`.
std::vector<CheckResult> check_solver(const solvers::Solver& solver,
                                      const std::vector<std::filesystem::path>& paths);

}  // namespace conebench::harness
