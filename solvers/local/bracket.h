#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace conebench::solvers {

/// A root of f in [low, high] with f(low) and f(high) of opposite sign, to the last bit or two:
/// secant steps that keep the bracket (Illinois), and a bisection every third step.
template <class Function>
double bracketed_root(const Function& f, double low, double high) {
  double f_low = f(low), f_high = f(high);
  int kept = 0;  // > 0: how often in a row the low end was kept; < 0: the high end
  if (f_low == 0.0) return low;
  if (f_high == 0.0) return high;
  for (int step = 0; step < 200; ++step) {
    const double width = high - low;
    if (width <= 2.0 * std::numeric_limits<double>::epsilon() * std::abs(high)) break;
    double x = high - f_high * width / (f_high - f_low);
    if (!(x > low && x < high) || step % 3 == 2) x = 0.5 * (low + high);
    const double fx = f(x);
    if (fx == 0.0) return x;
    if ((fx > 0.0) == (f_high > 0.0)) {
      high = x;
      f_high = fx;
      kept = std::max(kept, 0) + 1;
      if (kept > 1) f_low *= 0.5;
    } else {
      low = x;
      f_low = fx;
      kept = std::min(kept, 0) - 1;
      if (kept < -1) f_high *= 0.5;
    }
  }
  return std::abs(f(low)) < std::abs(f(high)) ? low : high;
}

/// Where f is least on [low, high], 0 < low: a logarithmic scan, then golden section around its
/// best point. For a function with one valley wider than the scan's spacing.
template <class Function>
double log_minimum(const Function& f, double low, double high, int points) {
  const double ratio = std::pow(high / low, 1.0 / (points - 1));
  double best = low, f_best = f(low), x = low;
  for (int k = 1; k < points; ++k) {
    x *= ratio;
    const double fx = f(x);
    if (fx < f_best) {
      f_best = fx;
      best = x;
    }
  }
  constexpr double kGolden = 0.6180339887498949;
  double left = best / ratio, right = best * ratio;
  for (int k = 0; k < 80; ++k) {
    const double a = right - kGolden * (right - left), b = left + kGolden * (right - left);
    (f(a) < f(b) ? right : left) = f(a) < f(b) ? b : a;
  }
  const double middle = 0.5 * (left + right);
  return f(middle) < f_best ? middle : best;
}

}  // namespace conebench::solvers
