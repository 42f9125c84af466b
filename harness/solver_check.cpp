#include "harness/solver_check.h"

#include "harness/problem_id.h"
#include "harness/small_problems.h"
#include "harness/worker.h"

namespace conebench::harness {
namespace {

constexpr double kTolerance = 1e-6, kTimeLimit_s = 5.0;

std::vector<ProblemSource> sources(const std::vector<std::filesystem::path>& paths) {
  if (!paths.empty()) return find_sources(paths, 1).problems;
  std::vector<ProblemSource> made;
  for (const NamedRecipe& named : small_recipes()) {
    made.push_back(
        {.id = {.name = named.name}, .load = [named] { return only(make_named(named)); }});
  }
  return made;
}

}  // namespace

std::vector<CheckResult> check_solver(const solvers::Solver& solver,
                                      const std::vector<std::filesystem::path>& paths) {
  std::vector<CheckResult> results;
  for (const ProblemSource& source : sources(paths)) {
    const auto record = run_task({.problems = {source},
                                  .solver = solver,
                                  .stop = {.tol = kTolerance, .time_limit_s = kTimeLimit_s}});
    if (!record) break;
    // r = 0, a solution here and there, is no merit of a solver that has broken down.
    const bool solved = record->solved() && record->status != results::Status::kDiverged;
    const bool passed = solved || record->status == results::Status::kUnsupported;
    results.push_back({.record = *record, .passed = passed});
  }
  return results;
}

}  // namespace conebench::harness
