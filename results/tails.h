#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "results/record.h"

namespace conebench::results {

/// The least of the values that at least a share p of them does not exceed: of n values the
/// ceil(p n)-th smallest, for 0 < p <= 1. Never interpolated: it is a value that occurred. Infinite
/// values sort last, so that a percentile that falls among failures is infinite. `values` not
/// empty.
double order_statistic(std::vector<double> values, double p);

/// The slow end of a list of times [s], in which a failure is infinite.
struct Tails {
  double p50 = 0.0, p90 = 0.0, p99 = 0.0, p99_9 = 0.0, max = 0.0;
  std::size_t count = 0, failures = 0;
};

/// Nothing for an empty list.
std::optional<Tails> tails(std::span<const double> times_s);

/// Below this an eta is rounding: half a unit in the last place of 1.
inline constexpr double kEtaFloor = 1e-16;

/// How exact the successes are. A failure is counted, never averaged in: nothing of a bad case is
/// hidden by the good ones.
struct ResidualMean {
  std::optional<double>
      mean;  ///< geometric, of max(eta, kEtaFloor) over the solved; nothing if none
  std::size_t solved = 0;
  std::size_t failed = 0;       ///< eta above the tolerance
  std::size_t unknown = 0;      ///< of them without a residual: no finite answer at all
  std::optional<double> worst;  ///< the largest finite eta
};

ResidualMean residual_mean(std::span<const Record> records);

}  // namespace conebench::results
