#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/policy.h"
#include "problems/problem_file.h"

namespace conebench::harness {

/// What is asked of a solver at every step.
struct Wish {
  double tol = 1e-5;      ///< on eta
  double budget_s = 0.0;  ///< wall clock of one solve
  double confidence = 0.95;
};

/// A step to be solved: the standard problem and the r' that its engine would start from.
struct Sample {
  problems::Problem standard;
  Eigen::VectorXd guess;
};

/// Where a step was not solved, its time is infinite.
struct Entrant {
  std::string solver;
  std::vector<double> times_s{};  ///< of the steps it ran on, in the order that it met them
  bool dropped = false;           ///< left the race before its end

  std::int64_t solved() const;
  std::int64_t within(double budget_s) const;
  /// The time within which `share` of its steps were solved; infinite if fewer were.
  double quantile_s(double share) const;
};

/// Solves steps with one solver after another, all solvers on one step before the next, each as an
/// engine would (islands too where `by_islands`). A step counts as solved when eta of the answer,
/// computed anew, is <= tol; nobody gets more than kPatience budgets.
///
/// The steps are taken in spread_order(): those of a run's beginning are often the easy ones. A
/// solver leaves the race when it is out_of_the_race(), at the earliest after four steps. A step
/// that a solver cannot take counts as not solved.
std::vector<Entrant> race(const std::vector<Sample>& samples,
                          const std::vector<std::string>& solvers, const Wish& wish,
                          bool by_islands);

/// 0 to count - 1, every stretch of them from all parts of the whole.
std::vector<std::size_t> spread_order(std::size_t count);

/// All but sure to lose: its share of steps within the budget is below the leader's with a
/// confidence of 95 % on both sides, or, with no more steps within the budget than the leader, its
/// median time is above kFarBehind times the leader's. (Not its mean: one hard step among easy ones
/// is no reason.)
bool out_of_the_race(const Entrant& entrant, const Entrant& leader, const Wish& wish);

inline constexpr double kPatience = 20.0;
inline constexpr double kFarBehind = 4.0;

/// A policy, and what it is compared with. Shares are of the validation steps, in [0, 1].
struct Advice {
  Policy policy;                ///< its probability is the bound from the validation steps
  bool meets = false;           ///< at least kEnough of the validation steps are within the budget
  std::string nearest;          ///< the solver that needs the least budget for kEnough of its steps
  double nearest_budget_s = 0;  ///< that budget; infinite where no solver solves enough steps
  std::vector<Entrant> chosen_among;  ///< as raced
  std::vector<Entrant> validation;    ///< the finalists, on steps that chose nothing
  double single_best = 0.0, virtual_best = 0.0;
  double best_pair = 0.0;  ///< of two solvers run side by side
  std::string pair;        ///< their names
};

inline constexpr double kEnough = 0.9;

/// Chooses on `training`, judges on `validation`; `fallback_limit_s` is the last rung's.
Advice advise(const std::vector<Sample>& training, const std::vector<Sample>& validation,
              const std::vector<std::string>& solvers, const Wish& wish, bool by_islands,
              double fallback_limit_s);

}  // namespace conebench::harness
