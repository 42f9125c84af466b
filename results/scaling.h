#pragma once

#include "results/block.h"
#include "results/group_numbers.h"
#include "results/plot.h"

namespace conebench::results {

/// How the time to the tolerance grows with the number of cones.
struct Scaling {
  Plot plot;    ///< median time of each class of sizes, a factor of 2 wide; failures are infinite
  Block block;  ///< exponent of a power law, and the largest problem solved
};

Scaling scaling(const GroupNumbers& numbers);

/// Least squares of log(y) = a + b log(x): b. Nothing unless the x span a factor of `least_span`.
std::optional<double> power_of(std::span<const double> x, std::span<const double> y,
                               double least_span = 4.0);

}  // namespace conebench::results
