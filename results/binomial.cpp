#include "results/binomial.h"

#include <cmath>

namespace conebench::results {
namespace {

// P(at least `successes` of `trials`) where each comes with probability p.
double upper_tail(std::int64_t successes, std::int64_t trials, double p) {
  const auto n = static_cast<double>(trials);
  double sum = 0.0;
  for (std::int64_t k = successes; k <= trials; ++k) {
    const auto x = static_cast<double>(k);
    const double log_ways = std::lgamma(n + 1.0) - std::lgamma(x + 1.0) - std::lgamma(n - x + 1.0);
    const double log_rest = k < trials ? (n - x) * std::log1p(-p) : 0.0;
    sum += std::exp(log_ways + x * std::log(p) + log_rest);
  }
  return sum;
}

}  // namespace

double binomial_lower_bound(std::int64_t successes, std::int64_t trials, double confidence) {
  if (successes == 0) return 0.0;
  double low = 0.0, high = 1.0;
  for (int halving = 0; halving < 60; ++halving) {
    const double p = 0.5 * (low + high);
    (upper_tail(successes, trials, p) <= 1.0 - confidence ? low : high) = p;
  }
  return low;
}

}  // namespace conebench::results
