#include "problems/engine/island_solver.h"

#include <utility>

namespace conebench::engine {
namespace {

std::vector<int> rows_of(const problems::Problem& problem, const std::vector<int>& cones) {
  std::vector<int> rows;
  for (const int cone : cones) {
    const int dim = problem.cones()[static_cast<std::size_t>(cone)].dim;
    for (int k = 0; k < dim; ++k) rows.push_back(problem.start(cone) + k);
  }
  return rows;
}

void add(const StepAnswer& part, StepAnswer& whole) {
  if (!part.converged && whole.converged) {
    whole.converged = false;
    whole.status = part.status;
  }
  if (whole.status.empty()) whole.status = part.status;
  whole.iterations += part.iterations;
  whole.solve_s += part.solve_s;
}

StepAnswer solve_parts(const StepSolver& solver, const problems::Problem& standard,
                       const Eigen::VectorXd& guess) {
  StepAnswer whole;
  whole.r = guess;
  whole.converged = true;
  for (const problems::Island& island : standard.islands()) {
    const std::vector<int> rows = rows_of(standard, island.cones);
    const StepAnswer part = solver(island.problem, guess(rows));
    check_answer(part, island.problem.rows(), standard.metadata().scene, standard.metadata().step);
    whole.r(rows) = part.r;
    add(part, whole);
  }
  return whole;
}

}  // namespace

StepSolver by_islands(StepSolver solver) {
  return [solver = std::move(solver)](const problems::Problem& standard,
                                      const Eigen::VectorXd& guess) {
    if (standard.island_count() <= 1) return solver(standard, guess);
    return solve_parts(solver, standard, guess);
  };
}

}  // namespace conebench::engine
