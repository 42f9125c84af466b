#pragma once

#include <cmath>

namespace conebench::solvers {

/// Step s in (0, 1] along a direction of descent by bisection on the slope of the merit function:
/// long enough where the slope has mostly gone, too long where it has turned.
///
/// slope(s)  derivative of the merit function along the direction at s
/// left      share of |slope(0)| at which a step is accepted
/// trials    most evaluations beyond that at 0; the last s is taken where none is accepted
template <typename Slope>
double slope_search(const Slope& slope, double left, int trials) {
  const double accepted = left * std::abs(slope(0.0));
  double s = 1.0, low = 0.0, high = 1.0;
  for (int trial = 0; trial < trials; ++trial) {
    const double here = slope(s);
    if (here <= accepted) {
      if (s == 1.0 || here >= -accepted) break;
      low = s;
    } else {
      high = s;
    }
    s = 0.5 * (low + high);
  }
  return s;
}

}  // namespace conebench::solvers
