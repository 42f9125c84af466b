// Every method on problems whose answers are known by construction, and on odd ones.
//
//   build/method_survey [--quick] [SOLVER...]
//
// Prints Markdown tables; exits 1 if a solver did what none may do (fault() in attempt.h), claimed
// to solve a problem without solution, or took a guess that holds a NaN. Without SOLVER: every
// registered method with its default parameters, models left out.

#include <fmt/format.h>

#include <cstdio>

#include "harness/survey/survey.h"
#include "problems/error.h"
#include "solvers/registry.h"

namespace conebench::harness {
namespace {

int survey(const Plan& plan) {
  Faults faults;
  odd_problems(plan, faults);
  equivalent_problems(plan, faults);
  several_solutions(plan, faults);
  without_solution(plan, faults);
  ordinary_problems(plan, faults);
  without_guarantee(plan, faults);
  return faults.print();
}

std::vector<solvers::Solver> every_method() {
  std::vector<solvers::Solver> found;
  for (const solvers::Method& method : solvers::all_methods()) {
    if (method.kind != solvers::Kind::kModel) found.push_back(solvers::make_solver(method.name));
  }
  return found;
}

}  // namespace
}  // namespace conebench::harness

int main(int argc, char** argv) try {
  conebench::harness::Plan plan;
  for (int k = 1; k < argc; ++k) {
    const std::string argument = argv[k];
    if (argument == "--quick") {
      plan.quick = true;
    } else {
      plan.solvers.push_back(conebench::solvers::make_solver(argument));
    }
  }
  if (plan.solvers.empty()) plan.solvers = conebench::harness::every_method();
  return conebench::harness::survey(plan);
} catch (const conebench::problems::InputError& error) {
  fmt::print(stderr, "{}\n", error.what());
  return 2;
}
