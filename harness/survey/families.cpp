// The sections on made problems: ordinary, of singular W, without solution, with several.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <random>

#include "harness/survey/survey.h"
#include "harness/survey/tables.h"
#include "harness/survey/transform.h"
#include "problems/residual.h"

namespace conebench::harness {
namespace {

using problems::Family;
using problems::MadeProblem;
using problems::Problem;
using problems::Recipe;
using solvers::Solver;
using solvers::Status;
using solvers::Stop;
using solvers::StopTest;

// What is known of the cones of a made problem: those at their tip, r' = u = 0.
using Tips = std::vector<bool>;

// Whether the cone of largest eta is at its tip in the solution that the problem was made from.
bool is_worst_at_a_tip(const Problem& problem, const Tips& tips, const Attempt& tried) {
  if (tried.r.size() == 0 || !tried.r.allFinite()) return false;
  Eigen::Index worst = 0;
  problems::evaluate_residual(problem.shifted(), tried.r).eta.per_cone.maxCoeff(&worst);
  return tips[static_cast<std::size_t>(worst)];
}

const std::vector<std::pair<std::string, std::vector<int>>> kDims = {
    {"1", {1}}, {"2", {2}}, {"3", {3}}, {"6", {6}}, {"mixed", {3, 1, 6, 2}}};

struct Made {
  Problem problem;
  Tips tips;
};

Tips tips_of(const MadeProblem& made) {
  const Eigen::VectorXd& r = made.solutions.at(0);
  const Eigen::VectorXd u = made.problem.shifted().rate(r);
  Tips tips;
  for (int i = 0; i < made.problem.cone_count(); ++i) {
    const int at = made.problem.start(i), dim = made.problem.start(i + 1) - at;
    const bool moves = u.segment(at, dim).norm() > 1e-9 * made.problem.rate_scale();
    tips.push_back(!moves && r.segment(at, dim).isZero(0.0));
  }
  return tips;
}

// One cone by itself is the sticking one of a made problem, the sliding one or that at its tip.
Made make(Recipe recipe) {
  const bool single = recipe.cones == 1;
  if (single) recipe.cones = 4;
  const MadeProblem made = problems::make_backwards(recipe);
  const Tips tips = tips_of(made);
  if (!single) return {made.problem, tips};
  const int cone = 1 + static_cast<int>(recipe.seed % 3);
  return {alone(made, cone), {tips[static_cast<std::size_t>(cone)]}};
}

int seeds_of(const Plan& plan, int cones) { return plan.quick || cones >= 1000 ? 1 : 5; }

void solve_each(const Plan& plan, const Problem& problem, Faults& faults,
                const std::function<void(const Solver&, const Attempt&)>& then) {
  const Stop stop = survey_stop(problem);
  for (const Solver& solver : plan.solvers) {
    then(solver, faults.watched_attempt(solver, problem, problem.name(), stop));
  }
}

// Two answers are one solution when their rates differ by less than this, relative to the larger.
constexpr double kSameRate = 1e-4;

}  // namespace

void ordinary_problems(const Plan& plan, Faults& faults) {
  Shares by_size, by_kind;
  for (const int cones : plan.quick ? std::vector{1, 10, 100} : std::vector{1, 10, 100, 1000}) {
    for (const auto& [dims_name, dims] : kDims) {
      for (const double cohesive : {0.0, 0.5}) {
        for (int seed = 1; seed <= seeds_of(plan, cones); ++seed) {
          const auto [problem, tips] = make({.cones = cones,
                                             .dims = dims,
                                             .cohesive_share = cohesive,
                                             .seed = static_cast<std::uint64_t>(seed)});
          const std::string size = fmt::format("{} cone{}", cones, cones == 1 ? "" : "s");
          const std::string kind = fmt::format("d = {}{}", dims_name, cohesive > 0 ? ", coh." : "");
          solve_each(plan, problem, faults, [&](const Solver& solver, const Attempt& tried) {
            const bool worst_at_tip = is_worst_at_a_tip(problem, tips, tried);
            by_size.add(solver, size, tried, worst_at_tip);
            by_kind.add(solver, kind, tried, worst_at_tip);
          });
        }
      }
    }
    std::fprintf(stderr, "ordinary, %d cones: done\n", cones);
  }
  fmt::print(
      "\n## Ordinary: solved to eta <= 1e-8\n\n"
      "Two rows to three dofs, mass ratio 10, mu 0.1 to 0.8; dry, and half the cones cohesive "
      "(\"coh.\"). {}\n"
      "W has full rank and a condition of 1e1 to 1e5 for d <= 3; for d = 6 it may be singular, and "
      "its condition reaches 1e12.\n"
      "Theory promises convergence only for d = 1, where the problem is convex; for Coulomb's law "
      "it is not, and what stands here is a rate.\n"
      "Every fourth cone is made to be at its tip, r' = u = 0, where interior points reach the "
      "square root of rounding: \"worst at a tip\" counts the unsolved problems whose largest eta "
      "is "
      "at one.\n",
      plan.quick ? "One seed of each kind." : "Five seeds of each kind, one of 1000 cones.");
  by_size.print(true);
  fmt::print("\nThe same solves by kind:\n");
  by_kind.print(false);
}

void without_guarantee(const Plan& plan, Faults& faults) {
  Shares shares;
  for (const auto& [family, name] : {std::pair{Family::kRankDeficient, "rank-deficient"},
                                     {Family::kSingularBlock, "singular block"}}) {
    for (const int cones : plan.quick ? std::vector{10} : std::vector{10, 100}) {
      for (const auto& [dims_name, dims] : kDims) {
        if (family == Family::kSingularBlock && dims == std::vector{1}) continue;
        for (int seed = 1; seed <= (plan.quick ? 1 : 2); ++seed) {
          const auto [problem, tips] = make({.family = family,
                                             .cones = cones,
                                             .dims = dims,
                                             .cohesive_share = 0.25,
                                             .seed = static_cast<std::uint64_t>(seed)});
          solve_each(plan, problem, faults, [&](const Solver& solver, const Attempt& tried) {
            shares.add(solver, fmt::format("{}, {}", name, cones), tried,
                       is_worst_at_a_tip(problem, tips, tried));
          });
        }
      }
      std::fprintf(stderr, "%s, %d cones: done\n", name, cones);
    }
  }
  fmt::print(
      "\n## No guarantee: singular W\n\n"
      "W rank-deficient (twice as many rows as dofs: r is not unique), or some W_ii singular; {} "
      "cones of all dimensions, a quarter cohesive, mu 0.1 to 0.8. Each has a solution.\n",
      plan.quick ? "10" : "10 and 100");
  shares.print(true);
}

void without_solution(const Plan& plan, Faults& faults) {
  std::map<std::string, std::array<int, 4>> counts;  // tried, claims, claims by own test, proofs
  for (const auto& [dims_name, dims] : kDims) {
    for (const int cones : {2, 20}) {
      const Problem problem = problems::make_backwards({.family = Family::kInfeasible,
                                                        .cones = cones,
                                                        .dims = dims,
                                                        .cohesive_share = 0.25,
                                                        .seed = static_cast<std::uint64_t>(cones)})
                                  .problem;
      for (const StopTest test : {StopTest::kCommon, StopTest::kOwn}) {
        const Stop stop{.tol = kSurveyTol, .time_limit_s = plan.quick ? 0.1 : 0.3, .test = test};
        for (const Solver& solver : plan.solvers) {
          const Attempt tried = faults.watched_attempt(solver, problem, problem.name(), stop);
          if (tried.end == Attempt::End::kRefused) continue;
          auto& [runs, claims, own_claims, proofs] = counts[solver.name];
          ++runs;
          if (tried.status == Status::kInfeasible) ++proofs;
          if (tried.status != Status::kConverged) continue;
          ++(test == StopTest::kOwn ? own_claims : claims);
          faults.add(solver, problem.name(),
                     fmt::format("claims to solve what has no solution, eta = {:.2g}", tried.eta));
        }
      }
    }
  }
  Table table("method");
  for (const Solver& solver : plan.solvers) {
    const auto& [runs, claims, own_claims, proofs] = counts[solver.name];
    table.at(solver.name, "runs") = std::to_string(runs);
    table.at(solver.name, "claims") = std::to_string(claims);
    table.at(solver.name, "claims by own test") = std::to_string(own_claims);
    table.at(solver.name, "proofs of infeasibility") = std::to_string(proofs);
  }
  fmt::print(
      "\n## No solution: never converged\n\n"
      "Opposed walls that close in; 2 and 20 cones of every dimension, both stopping tests.\n");
  table.print();
}

void several_solutions(const Plan& plan, Faults& faults) {
  constexpr int kStarts = 10;
  Table table("method");
  for (const auto& [dims_name, dims] : kDims) {
    if (dims == std::vector{1}) continue;
    const std::vector<int> allowed = dims_name == "mixed" ? std::vector{3, 6, 2} : dims;
    const Problem problem =
        problems::make_backwards(
            {.family = Family::kSeveral, .cones = 3, .dims = allowed, .seed = 5})
            .problem;
    const Stop stop = survey_stop(problem);
    for (const Solver& solver : plan.solvers) {
      std::mt19937_64 random(7);
      std::normal_distribution<double> normal;
      std::vector<Eigen::VectorXd> distinct;
      int solved = 0, tried_count = 0;
      double spread = 0.0, size = 0.0;
      for (int start = 0; start < kStarts; ++start) {
        Eigen::VectorXd guess(problem.rows());
        for (double& x : guess) x = normal(random);
        const Attempt tried = faults.watched_attempt(solver, problem, problem.name(), stop, guess);
        if (tried.end == Attempt::End::kRefused) break;
        ++tried_count;
        if (!tried.solved(kSurveyTol)) continue;
        ++solved;
        const Eigen::VectorXd u = problem.rate(tried.r);
        size = std::max(size, u.norm());
        double nearest = std::numeric_limits<double>::infinity();
        for (const Eigen::VectorXd& other : distinct) {
          nearest = std::min(nearest, (u - other).norm());
          spread = std::max(spread, (u - other).norm());
        }
        if (nearest > kSameRate * size) distinct.push_back(u);
      }
      if (tried_count == 0) continue;
      table.at(solver.name, "d = " + dims_name) =
          fmt::format("{}/{}; {}; {:.1e}", solved, tried_count, distinct.size(),
                      size > 0.0 ? spread / size : 0.0);
    }
  }
  fmt::print(
      "\n## Several solutions: spread of u over {} random starts\n\n"
      "Three wedged cones, each of which may open or slide: 8 solutions and more. Solved / starts; "
      "distinct u found; largest |u_a - u_b| / largest |u|.\n",
      kStarts);
  table.print();
}

}  // namespace conebench::harness
