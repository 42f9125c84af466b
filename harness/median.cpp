#include "harness/median.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace conebench::harness {
namespace {

constexpr double kOutside = 0.05;  // 1 - confidence

// P(B = k), B binomial (n, 1/2).
double binomial(std::size_t n, std::size_t k) {
  const auto all = static_cast<double>(n), some = static_cast<double>(k);
  return std::exp(std::lgamma(all + 1.0) - std::lgamma(some + 1.0) - std::lgamma(all - some + 1.0) -
                  all * std::numbers::ln2);
}

// The rank of the lower end, counted from 1; 0 if there is none.
std::size_t lower_rank(std::size_t n) {
  std::size_t rank = 0;
  for (double below = binomial(n, 0); 2.0 * below <= kOutside; below += binomial(n, rank)) ++rank;
  return rank;
}

}  // namespace

double MedianInterval::spread() const { return 0.5 * (high - low) / median; }

MedianInterval median_interval(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size(), rank = lower_rank(n);
  constexpr double kUnbounded = std::numeric_limits<double>::infinity();
  return {.median = 0.5 * (values[(n - 1) / 2] + values[n / 2]),
          .low = rank > 0 ? values[rank - 1] : -kUnbounded,
          .high = rank > 0 ? values[n - rank] : kUnbounded};
}

}  // namespace conebench::harness
