#pragma once

#include <functional>
#include <string>

#include "harness/problem_id.h"
#include "harness/tasks.h"
#include "problems/problem.h"
#include "solvers/solver.h"

namespace conebench::harness {

/// One contact on the ground, W = 1 and q = (-1, 0.25, 0), mu = 0.5: it sticks, r = (1, -0.25, 0).
inline problems::Problem one_contact() {
  problems::SparseMatrix W(3, 3);
  W.setIdentity();
  problems::Metadata metadata;
  metadata.name = "one-contact";
  return {problems::ReducedData{W, Eigen::Vector3d(-1.0, 0.25, 0.0)},
          {problems::Cone::coulomb(3, 0.5)},
          metadata};
}

/// The problem as a source of a campaign; `name` stands for different content.
inline ProblemSource source_named(const std::string& name) {
  return {.id = {.name = name, .content_sha256 = "sha-of-" + name, .cones = 1},
          .load = [] { return only(one_contact()); }};
}

/// A solver that does what the function does and claims success.
inline solvers::Solver solver_that(const std::string& name,
                                   const std::function<void(Eigen::VectorXd& r)>& act) {
  solvers::Solver solver;
  solver.name = name;
  solver.refuses = [](const problems::Problem&) { return std::optional<std::string>(); };
  solver.solve = [act](const problems::Problem& standard, const solvers::Request&) {
    solvers::Result result;
    result.status = solvers::Status::kConverged;
    result.r = Eigen::VectorXd::Zero(standard.rows());
    act(result.r);
    return result;
  };
  return solver;
}

inline solvers::Solver honest_solver() {
  return solver_that("honest", [](Eigen::VectorXd& r) { r << 1.0, -0.25, 0.0; });
}

/// Tolerance 1e-8, limits of a second.
inline Plan small_plan(const std::vector<solvers::Solver>& solvers) {
  return {.stops = {{.tol = 1e-8, .time_limit_s = 1.0}},
          .solvers = {solvers.begin(), solvers.end()},
          .modes = {Mode::kCold},
          .donors = {std::nullopt},
          .threads = {1},
          .hard_limit_s = 1.0};
}

/// All tasks of a plan in its random order.
inline std::vector<Task> tasks_of(const Plan& plan, const std::vector<ProblemSource>& problems) {
  std::vector<Task> tasks = tasks_of_shard(make_task_groups(plan, problems).groups, {});
  shuffle(tasks, plan.seed);
  return tasks;
}

}  // namespace conebench::harness
