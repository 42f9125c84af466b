#include "solvers/newton/line_search.h"

#include <algorithm>
#include <cmath>

namespace conebench::solvers {
namespace {

constexpr std::size_t kMemory = 9;  // merits of earlier iterates
constexpr int kTrials = 30;
constexpr double kArmijoShare = 1e-4;
constexpr double kShortest = 0.9, kLongest = 0.1;  // Goldstein and Price

using Merit = std::function<double(double)>;

std::optional<double> armijo(const Merit& merit, double reference, double slope0) {
  double t = 1.0;
  for (int trial = 0; trial < kTrials; ++trial, t *= 0.5) {
    if (merit(t) <= reference + kArmijoShare * t * slope0) return t;
  }
  return std::nullopt;
}

// The bracket (low, high) shrinks to a step that is neither too long nor, while it can still
// grow, too short.
std::optional<double> goldstein_price(const Merit& merit, double merit0, double slope0) {
  double low = 0.0, high = 0.0, t = 1.0;  // high = 0: not found yet
  for (int trial = 0; trial < kTrials; ++trial) {
    const double reached = merit(t);
    if (!(reached <= merit0 + kLongest * t * slope0)) {
      high = t;
    } else if (reached < merit0 + kShortest * t * slope0) {
      low = t;
    } else {
      return t;
    }
    t = high > 0.0 ? 0.5 * (low + high) : 2.0 * t;
  }
  return low > 0.0 ? std::optional(low) : std::nullopt;
}

}  // namespace

std::optional<double> StepLength::find(const Merit& merit, double merit0, double slope0) {
  switch (kind_) {
    case LineSearch::kNone:
      return std::isfinite(merit(1.0)) ? std::optional(1.0) : std::nullopt;
    case LineSearch::kArmijo:
      return armijo(merit, merit0, slope0);
    case LineSearch::kGoldsteinPrice:
      return goldstein_price(merit, merit0, slope0);
    case LineSearch::kNonMonotone:
      return non_monotone(merit, merit0, slope0);
  }
  return std::nullopt;
}

std::optional<double> StepLength::non_monotone(const Merit& merit, double merit0, double slope0) {
  double reference = merit0;
  for (const double before : merits_) reference = std::max(reference, before);
  const auto t = armijo(merit, reference, slope0);
  if (!t) return t;
  if (merits_.size() == kMemory) merits_.pop_front();
  merits_.push_back(merit0);
  return t;
}

}  // namespace conebench::solvers
