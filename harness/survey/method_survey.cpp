// Every method on problems whose answers are known by construction, and on odd ones.
//
//   build/method_survey [--quick] [SOLVER...]
//
// Prints Markdown tables; exits 1 if a solver did what none may do (fault() in attempt.h), claimed
// to solve a problem without solution, or took a guess that holds a NaN. Without SOLVER: every
// registered method with its default parameters, models left out.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <random>

#include "harness/survey/attempt.h"
#include "harness/survey/transform.h"
#include "problems/error.h"
#include "problems/residual.h"
#include "solvers/registry.h"

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

constexpr double kTol = 1e-8;

struct Plan {
  bool quick = false;
  std::vector<Solver> solvers;
};

// Small problems that are not solved in this time are not solved at all.
double time_limit(const Problem& problem) { return problem.cone_count() <= 30 ? 1.0 : 5.0; }

// What went wrong beyond "not solved"; printed at the end.
class Faults {
 public:
  void add(const Solver& solver, const std::string& problem, const std::string& what) {
    lines_.push_back(fmt::format("{} on {}: {}", solver.name, problem, what));
  }
  void add_if_any(const Solver& solver, const Attempt& tried, const Problem& problem,
                  const std::string& name, const Stop& stop) {
    const std::string what = fault(tried, problem, stop);
    if (!what.empty()) add(solver, name, what);
  }
  int print() const {
    fmt::print("\n## Faults\n\n");
    if (lines_.empty()) fmt::print("None.\n");
    for (const std::string& line : lines_) fmt::print("- {}\n", line);
    return lines_.empty() ? 0 : 1;
  }

 private:
  std::vector<std::string> lines_;
};

// A Markdown table; rows and columns in the order of their first mention.
class Table {
 public:
  explicit Table(std::string corner) : corner_(std::move(corner)) {}

  std::string& at(const std::string& row, const std::string& column) {
    mention(rows_, row);
    mention(columns_, column);
    return cells_[{row, column}];
  }

  void print() const {
    fmt::print("\n| {} |", corner_);
    for (const std::string& column : columns_) fmt::print(" {} |", column);
    fmt::print("\n|---|");
    for (std::size_t k = 0; k < columns_.size(); ++k) fmt::print("---|");
    for (const std::string& row : rows_) {
      fmt::print("\n| {} |", row);
      for (const std::string& column : columns_) {
        const auto cell = cells_.find({row, column});
        fmt::print(" {} |", cell == cells_.end() ? "" : cell->second);
      }
    }
    fmt::print("\n");
    std::fflush(stdout);
  }

 private:
  static void mention(std::vector<std::string>& names, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }

  std::string corner_;
  std::vector<std::string> rows_, columns_;
  std::map<std::pair<std::string, std::string>, std::string> cells_;
};

struct Share {
  int solved = 0, tried = 0;

  std::string text() const { return tried == 0 ? "" : fmt::format("{}/{}", solved, tried); }
};

// What is known of the cones of a made problem: those at their tip, r' = u = 0.
using Tips = std::vector<bool>;

// Whether the cone of largest eta is at its tip in the solution that the problem was made from.
bool is_worst_at_a_tip(const Problem& problem, const Tips& tips, const Attempt& tried) {
  if (tried.r.size() == 0 || !tried.r.allFinite()) return false;
  Eigen::Index worst = 0;
  problems::evaluate_residual(problem.shifted(), tried.r).eta.per_cone.maxCoeff(&worst);
  return tips[static_cast<std::size_t>(worst)];
}

// Shares of solved problems, and how the rest ended.
class Shares {
 public:
  void add(const Solver& solver, const std::string& column, const Attempt& tried,
           bool worst_at_tip) {
    if (tried.end == Attempt::End::kRefused) return;
    Share& share = shares_[{solver.name, column}];
    ++share.tried;
    table_.at(solver.name, column);
    if (tried.solved(kTol)) {
      ++share.solved;
      return;
    }
    Rest& rest = rest_[solver.name];
    ++rest.endings[ending(tried)];
    if (worst_at_tip) ++rest.worst_at_tip;
    rest.worst = std::max(rest.worst, tried.eta);
  }

  void print(bool with_rest) {
    for (const auto& [key, share] : shares_) table_.at(key.first, key.second) = share.text();
    if (with_rest) {
      for (const auto& [solver, rest] : rest_) {
        std::string& cell = table_.at(solver, "the others");
        for (const auto& [end, count] : rest.endings) cell += fmt::format("{} {}, ", count, end);
        cell += fmt::format("eta up to {:.1e}", rest.worst);
        if (rest.worst_at_tip > 0) cell += fmt::format("; {} worst at a tip", rest.worst_at_tip);
      }
    }
    table_.print();
  }

 private:
  struct Rest {
    std::map<std::string, int> endings;
    int worst_at_tip = 0;
    double worst = 0.0;
  };

  Table table_{"method"};
  std::map<std::pair<std::string, std::string>, Share> shares_;
  std::map<std::string, Rest> rest_;
};

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
  const Stop stop{.tol = kTol, .time_limit_s = time_limit(problem)};
  for (const Solver& solver : plan.solvers) {
    const Attempt tried = attempt(solver, problem, stop);
    faults.add_if_any(solver, tried, problem, problem.name(), stop);
    then(solver, tried);
  }
}

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
        const Stop stop{.tol = kTol, .time_limit_s = plan.quick ? 0.1 : 0.3, .test = test};
        for (const Solver& solver : plan.solvers) {
          const Attempt tried = attempt(solver, problem, stop);
          faults.add_if_any(solver, tried, problem, problem.name(), stop);
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

// Two answers are one solution when their rates differ by less than this, relative to the larger.
constexpr double kSameRate = 1e-4;

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
    const Stop stop{.tol = kTol, .time_limit_s = time_limit(problem)};
    for (const Solver& solver : plan.solvers) {
      std::mt19937_64 random(7);
      std::normal_distribution<double> normal;
      std::vector<Eigen::VectorXd> distinct;
      int solved = 0, tried_count = 0;
      double spread = 0.0, size = 0.0;
      for (int start = 0; start < kStarts; ++start) {
        Eigen::VectorXd guess(problem.rows());
        for (double& x : guess) x = normal(random);
        const Attempt tried = attempt(solver, problem, stop, guess);
        faults.add_if_any(solver, tried, problem, problem.name(), stop);
        if (tried.end == Attempt::End::kRefused) break;
        ++tried_count;
        if (!tried.solved(kTol)) continue;
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

std::string short_answer(const Attempt& tried) {
  if (tried.end == Attempt::End::kRefused) return "";
  if (tried.end != Attempt::End::kReturned) return ending(tried);
  const bool converged = tried.status == Status::kConverged;
  return fmt::format("{}{:.0e}", converged ? "" : ending(tried) + ", ", tried.eta);
}

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

void odd_problems(const Plan& plan, Faults& faults) {
  const Recipe large_mu{.mu_low = 5.0, .mu_high = 5.0, .seed = 12};
  const Recipe tiny_mu{.mu_low = 1e-10, .mu_high = 1e-10, .seed = 13};
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
    const Attempt tried = attempt(solver, first, {.tol = kTol, .time_limit_s = 1.0}, bad);
    table.at(solver.name, "NaN guess") = short_answer(tried);
    if (tried.end != Attempt::End::kInputError) faults.add(solver, "NaN guess", "no InputError");
    for (const auto& [name, problem] : cases) {
      const Stop stop{.tol = kTol, .time_limit_s = time_limit(problem)};
      const Attempt answer = attempt(solver, problem, stop);
      table.at(solver.name, name) = short_answer(answer);
      faults.add_if_any(solver, answer, problem, name, stop);
      if (name == unsolvable && answer.status == Status::kConverged) {
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

// How a twin's answer compares with the answer to the original.
std::string compare(const Problem& original, const Attempt& first, const Twin& twin,
                    const Attempt& second) {
  if (!first.solved(kTol) || !second.solved(kTol)) return short_answer(second);
  const Eigen::VectorXd r = twin.r_back * second.r;
  const double eta = problems::evaluate_eta(original.shifted(), r);
  const Eigen::VectorXd u = original.shifted().rate(first.r);
  const Eigen::VectorXd u_twin = twin.u_back * twin.problem.shifted().rate(second.r);
  return fmt::format("{:.0e}; {:.3f}; {:.0e}; {}", second.eta,
                     second.eta > 0.0 ? eta / second.eta : 1.0, (u - u_twin).norm() / u.norm(),
                     second.iterations);
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
  const Stop stop{.tol = kTol, .time_limit_s = 1.0};
  Table table("method");
  for (const Solver& solver : plan.solvers) {
    const Attempt first = attempt(solver, original, stop);
    faults.add_if_any(solver, first, original, "the original", stop);
    table.at(solver.name, "original: eta; iterations") =
        short_answer(first) + fmt::format("; {}", first.iterations);
    for (const auto& [name, twin] : twins) {
      const Attempt second = attempt(solver, twin.problem, stop);
      faults.add_if_any(solver, second, twin.problem, name, stop);
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

std::vector<Solver> every_method() {
  std::vector<Solver> found;
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
