#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "problems/engine/step_solver.h"

namespace conebench::harness {

/// Which solver an engine takes for its steps, and which ones when that one misses: what `advise`
/// writes and `solver.name = "policy:FILE"` reads back.
struct Policy {
  struct Rung {
    std::string solver;         ///< a variant
    double time_limit_s = 0.0;  ///< of one solve, > 0
  };

  std::string scene;         ///< that it was made for
  double tol = 0.0;          ///< on eta
  double budget_s = 0.0;     ///< of one solve
  double confidence = 0.0;   ///< of the bound below
  double probability = 0.0;  ///< lower bound of P(first rung: time <= budget and eta <= tol)
  std::vector<Rung> ladder;  ///< tried in this order, at least one
};

/// As TOML, with what the numbers mean.
std::string to_toml(const Policy& policy);

/// Errors: InputError naming file, line and key; an unknown solver is one.
Policy read_policy(const std::filesystem::path& path);

/// Climbs the ladder: each rung that can take the step starts from the best r' so far and is judged
/// with eta; the first answer with eta <= tol is taken, else the best of all. `max_iterations`
/// holds for every rung. Throws InputError at a step of which no rung has a finite answer.
engine::StepSolver make_policy_solver(const Policy& policy, std::int64_t max_iterations);

}  // namespace conebench::harness
