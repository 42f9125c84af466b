#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/bootstrap.h"
#include "results/noise.h"
#include "results/profiles.h"

namespace conebench::results {

/// The noise floor that is assumed where no task was repeated.
inline constexpr double kAssumedNoise = 1.10;

/// Two solvers on the problems that both were run on.
struct SolverPair {
  std::string first, second;
  int problems = 0;               ///< that both were run on
  int both_solved = 0;            ///< of them
  double share_difference = 0.0;  ///< share solved by the first minus that by the second
  std::optional<Interval> share_interval{};
  std::optional<double> time_ratio{};  ///< geometric mean of first over second where both solve
  std::optional<Interval> time_interval{};
  double noise = kAssumedNoise;  ///< two identical solvers' ratio lies in [1/noise, noise]
  bool noise_is_measured = false;

  /// One solves more: the interval of the difference does not hold 0.
  bool told_apart_by_share() const;
  /// One is faster: the interval of the ratio does not hold 1, and the ratio is outside the noise.
  bool told_apart_by_time() const;
  /// No order of the two is claimed unless this is true; without intervals it never is.
  bool told_apart() const { return told_apart_by_share() || told_apart_by_time(); }
};

/// Intervals are 95 %, from a bootstrap over scenes, each pair by itself: of 20 pairs that do not
/// differ, one is expected to be told apart.
SolverPair compare_pair(const TimeTable& table, const RepeatedTimes& repeated, std::size_t first,
                        std::size_t second);

/// Every pair, first before second in the order of `table.solvers`.
/// Cost: solvers^2 / 2 times (rows + kResamples x scenes).
std::vector<SolverPair> compare_pairs(const TimeTable& table, const RepeatedTimes& repeated);

}  // namespace conebench::results
