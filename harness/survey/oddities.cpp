// The sections on odd problems, and on one problem said in other words.

#include <fmt/format.h>

#include <limits>

#include "harness/survey/survey.h"
#include "harness/survey/tables.h"
#include "harness/survey/transform.h"
#include "problems/residual.h"

namespace conebench::harness {
namespace {

using problems::MadeProblem;
using problems::Problem;
using solvers::Solver;
using solvers::Stop;

Problem empty_problem() {
  problems::SparseMatrix M(3, 3);
  M.setIdentity();
  return Problem(problems::PrimalData{M, problems::SparseMatrix(0, 3), Eigen::Vector3d::Ones(),
                                      Eigen::VectorXd(0)},
                 {}, {});
}

MadeProblem ordinary() {
  return problems::make_backwards({.mu_high = 0.4, .cohesive_share = 0.3, .seed = 11});
}

// How a twin's answer compares with the answer to the original.
std::string compare(const Problem& original, const Attempt& first, const Twin& twin,
                    const Attempt& second) {
  if (!first.solved(kSurveyTol) || !second.solved(kSurveyTol)) return short_answer(second);
  const Eigen::VectorXd r = twin.r_back * second.r;
  const double eta = problems::evaluate_eta(original.shifted(), r);
  const Eigen::VectorXd u = original.shifted().rate(first.r);
  const Eigen::VectorXd u_twin = twin.u_back * twin.problem.shifted().rate(second.r);
  return fmt::format("{:.0e}; {:.3f}; {:.0e}; {}", second.eta,
                     second.eta > 0.0 ? eta / second.eta : 1.0, (u - u_twin).norm() / u.norm(),
                     second.iterations);
}

}  // namespace

void odd_problems(const Plan& plan, Faults& faults) {
  const problems::Recipe large_mu{.mu_low = 5.0, .mu_high = 5.0, .seed = 12};
  const problems::Recipe tiny_mu{.mu_low = 1e-10, .mu_high = 1e-10, .seed = 13};
  const Problem dry = problems::make_backwards({.mu_high = 0.4, .seed = 11}).problem;
  const std::vector<std::pair<std::string, Problem>> cases = {
      {"empty", empty_problem()},
      {"one cone", alone(ordinary(), 2)},
      {"mu = 5", problems::make_backwards(large_mu).problem},
      {"mu = 1e-10", problems::make_backwards(tiny_mu).problem},
      {"kappa = 1e6", with_strength(dry, 1e6)},
      {"W_ii = 0, opens", with_prescribed_rate(dry, 0, Eigen::Vector3d(1.0, 0.3, -0.2))},
      {"W_ii = 0, slides off", with_prescribed_rate(dry, 0, Eigen::Vector3d(0.0, 0.3, -0.2))},
      {"W_ii = 0, closes (no solution)",
       with_prescribed_rate(dry, 0, Eigen::Vector3d(-1.0, 0.3, -0.2))},
  };
  const std::string unsolvable = cases.back().first;
  Table table("method");
  const Problem first = ordinary().problem;
  Eigen::VectorXd bad = Eigen::VectorXd::Zero(first.rows());
  bad(4) = std::numeric_limits<double>::quiet_NaN();
  for (const Solver& solver : plan.solvers) {
    const Attempt tried = attempt(solver, first, {.tol = kSurveyTol, .time_limit_s = 1.0}, bad);
    table.at(solver.name, "NaN guess") = short_answer(tried);
    if (tried.end != Attempt::End::kInputError) faults.add(solver, "NaN guess", "no InputError");
    for (const auto& [name, problem] : cases) {
      const Attempt answer = faults.watched_attempt(solver, problem, name, survey_stop(problem));
      table.at(solver.name, name) = short_answer(answer);
      if (name == unsolvable && answer.status == solvers::Status::kConverged) {
        faults.add(solver, name, "claims to solve it");
      }
    }
  }
  fmt::print(
      "\n## Odd problems\n\n"
      "eta where the status is `converged`, otherwise status and eta. 20 cones, d = 3. kappa is "
      "1e6 times the other forces; a cone with W_ii = 0 moves as prescribed whatever r is.\n");
  table.print();
}

void equivalent_problems(const Plan& plan, Faults& faults) {
  const Problem original = ordinary().problem;
  const std::vector<std::pair<std::string, Twin>> twins = {
      {"forces x 1e6", in_units(original, 1e6, 1.0)},
      {"rates x 1e6", in_units(original, 1.0, 1e6)},
      {"forces x 1e-6, rates x 1e6", in_units(original, 1e-6, 1e6)},
      {"turned tangents", with_turned_tangents(original, 14)},
      {"random order", in_random_order(original, 15)},
      {"every cone twice", with_cones_twice(original)},
  };
  const Stop stop{.tol = kSurveyTol, .time_limit_s = 1.0};
  Table table("method");
  for (const Solver& solver : plan.solvers) {
    const Attempt first = faults.watched_attempt(solver, original, "the original", stop);
    table.at(solver.name, "original: eta; iterations") =
        short_answer(first) + fmt::format("; {}", first.iterations);
    for (const auto& [name, twin] : twins) {
      const Attempt second = faults.watched_attempt(solver, twin.problem, name, stop);
      table.at(solver.name, name) = compare(original, first, twin, second);
    }
  }
  fmt::print(
      "\n## The same problem in other words\n\n"
      "eta; eta of the answer taken back to the original, over eta; |u - u_original| / |u|; "
      "iterations; the first alone unless both problems are solved. 20 cones, d = 3, a third "
      "cohesive.\n");
  table.print();
}

}  // namespace conebench::harness
