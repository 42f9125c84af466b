#pragma once

#include <vector>

namespace conebench::harness {

/// The median of a sample and the 95 % confidence interval of the median of what it was drawn from.
struct MedianInterval {
  double median = 0.0;
  double low = 0.0, high = 0.0;  ///< infinite with fewer than six values: they bound nothing

  /// Half width over the median [-]; infinite likewise.
  double spread() const;
};

/// By order statistics, whatever the distribution: low and high are the values of rank l and
/// n + 1 - l with the largest l for which 2 P(B <= l - 1) <= 5 %, B binomial (n, 1/2). Of an even
/// number of values the median is the mean of the middle two. Precondition: not empty.
MedianInterval median_interval(std::vector<double> values);

}  // namespace conebench::harness
