#pragma once

#include <span>
#include <string>
#include <vector>

#include "results/profiles.h"

namespace conebench::results {

/// From `value` on, this share is reached.
struct Step {
  double value = 0.0;
  double share = 0.0;  ///< in [0, 1]
};

/// The empirical distribution of the values as a share of `count`: where some are infinite, or
/// fewer than `count` are given, it ends below 1.
std::vector<Step> cumulative_shares(std::vector<double> values, std::size_t count);

/// For each solver the share of problems solved within a time [s]: the ECDF of its times, in which
/// failures are never reached. Over comparable(table).
std::vector<std::vector<Step>> time_distributions(const TimeTable& table);

/// Data profiles (More and Wild, SIAM J. Optim. 20(1), 2009, eq. 2.2): for each solver the share of
/// problems solved within a budget that grows with the size of the problem. They count in function
/// evaluations over n + 1; here the unit is solver time per cone [s], since neither an iteration
/// nor a sweep costs the same in two methods. Unlike a performance profile, a solver's curve does
/// not depend on which others are shown. Over comparable(table).
std::vector<std::vector<Step>> data_profiles(const TimeTable& table);

/// 0.1, 0.01, ... while above `tol`, then `tol`.
std::vector<double> tolerance_ladder(double tol);

/// How many problems each solver solves to each tolerance, within the time limit.
struct SolvedCounts {
  std::vector<double> tolerances;        ///< falling
  std::vector<std::string> solvers;      ///< in alphabetical order
  std::vector<std::vector<int>> solved;  ///< of each solver, one a tolerance
  int problems = 0;                      ///< that every solver was run on
};

/// To the tolerances of the ladder down to `tol`.
SolvedCounts solved_counts(std::span<const Record> records, double tol);

/// The same from one comparable() time table a tolerance, falling; at least one.
SolvedCounts solved_counts(std::span<const TimeTable> tables);

}  // namespace conebench::results
