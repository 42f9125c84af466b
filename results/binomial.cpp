#include "results/binomial.h"

#include <algorithm>
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

// How many times the variance of shares of windows is that of independent trials, at least 1.
double design_effect(const std::vector<bool>& successes, double share) {
  const double independent = share * (1.0 - share);
  const std::size_t n = successes.size();
  const auto windows = static_cast<std::size_t>(std::lround(std::sqrt(static_cast<double>(n))));
  if (windows < 2 || independent <= 0.0) return 1.0;
  double square = 0.0;
  for (std::size_t k = 0; k < windows; ++k) {
    const std::size_t begin = k * n / windows, end = (k + 1) * n / windows;
    double found = 0.0;
    for (std::size_t i = begin; i < end; ++i) found += successes[i] ? 1.0 : 0.0;
    const auto size = static_cast<double>(end - begin);
    square += size * (found / size - share) * (found / size - share);
  }
  return std::max(square / static_cast<double>(windows - 1) / independent, 1.0);
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

double run_lower_bound(const std::vector<bool>& successes, double confidence) {
  const auto n = static_cast<double>(successes.size());
  const double share = static_cast<double>(std::ranges::count(successes, true)) / n;
  const double trials = std::max(std::floor(n / design_effect(successes, share)), 1.0);
  return binomial_lower_bound(static_cast<std::int64_t>(std::floor(share * trials + 1e-9)),
                              static_cast<std::int64_t>(trials), confidence);
}

}  // namespace conebench::results
