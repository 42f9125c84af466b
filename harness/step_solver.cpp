#include "harness/step_solver.h"

#include "harness/policy.h"
#include "harness/variants.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

// Steps pay for the looks at eta, of which one costs as much as two iterations of a cheap method.
constexpr double kLookGrowth = 0.1;

}  // namespace

engine::StepSolver make_step_solver(const engine::SolverChoice& choice) {
  const solvers::Stop stop{.tol = choice.tol,
                           .max_iterations = choice.max_iterations,
                           .time_limit_s = choice.time_limit_s,
                           .look_growth = kLookGrowth};
  stop.check();
  constexpr std::string_view kPolicy = "policy:";
  if (choice.name.starts_with(kPolicy)) {
    return make_policy_solver(read_policy(choice.name.substr(kPolicy.size())),
                              choice.max_iterations);
  }
  return [solver = make_solver(choice.name), stop](const problems::Problem& standard,
                                                   const Eigen::VectorXd& guess) {
    if (const auto reason = solver.refuses(standard)) {
      throw problems::InputError(standard.name(), solver.name + " cannot solve it: " + *reason);
    }
    const solvers::Result result = solver.solve(standard, {.stop = stop, .guess = guess});
    return engine::StepAnswer{result.r, result.status == solvers::Status::kConverged,
                              std::string(solvers::to_string(result.status)), result.iterations,
                              result.setup_s + result.solve_s};
  };
}

}  // namespace conebench::harness
