#include "solvers/ccp.h"

#include "solvers/method.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;

// Only the answer is shown to the monitor: iterates of the model are no steps towards the solution
// of the problem as posed, which is what it would look for.
Result solve_associated(const Solver& inner, const Problem& problem, const Stop& stop,
                        Eigen::VectorXd guess, Monitor& monitor) {
  const Problem model = associated_problem(problem);
  const double posing_s = monitor.elapsed_s();
  Stop inner_stop = stop;
  inner_stop.time_limit_s = std::max(stop.time_limit_s - posing_s, 1e-9);
  Result result = inner.solve(model, {inner_stop, std::move(guess), nullptr});
  monitor.set_clock(posing_s + result.setup_s, result.solve_s);
  result.status = monitor.conclude(result.status, result.iterations, result.r);
  return result;
}

Solver make(const Method& method, const Values& values) {
  const Solver inner = make_solver(std::get<std::string>(values.at("method")));
  const auto iterate = [inner](const Problem& problem, const Stop& stop, Eigen::VectorXd guess,
                               Monitor& monitor) {
    return solve_associated(inner, problem, stop, std::move(guess), monitor);
  };
  return make_checked_solver(method, values, inner.refuses, iterate);
}

}  // namespace

Problem associated_problem(const Problem& problem) {
  std::vector<Cone> cones(problem.cones().begin(), problem.cones().end());
  for (Cone& cone : cones) cone.theta = 0.0;
  if (problem.is_primal()) {
    return Problem(problems::PrimalData{problem.M(), problem.H(), problem.f(), problem.w()},
                   std::move(cones), problem.metadata(), problem.rate_scale());
  }
  return Problem(problems::ReducedData{problem.W(), problem.q()}, std::move(cones),
                 problem.metadata(), problem.rate_scale());
}

Method cone_complementarity_model() {
  Method method{
      .name = "ccp",
      .kind = Kind::kModel,
      .summary = "model: the associated law, a convex problem (Anitescu-Tasora)",
      .source = "Anitescu, Tasora, Comput. Optim. Appl. 47(2) (2010) 207-235 (not checked)",
      .parameters = {{.name = "method",
                      .fallback = std::string("ipm"),
                      .choices = {"aclm", "gs", "ipm", "spg"},
                      .doc = "which of our methods solves the convex problem"}},
      .make = {}};
  method.make = [method](const Values& values) { return make(method, values); };
  return method;
}

}  // namespace conebench::solvers
