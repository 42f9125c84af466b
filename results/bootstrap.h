#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/record.h"

namespace conebench::results {

/// The scene that a problem is a step of: its family, or the problem itself where no file says one.
const std::string& scene_of(const ProblemId& problem);

/// Rows numbered by scene.
struct Scenes {
  std::vector<std::string> names;   ///< sorted, each once
  std::vector<std::size_t> of_row;  ///< index into `names`
};
Scenes number_scenes(std::span<const std::string> scene_of_row);

/// The limits are infinite where the data set none.
struct Interval {
  double low = 0.0, high = 0.0;
  bool holds(double value) const { return low <= value && value <= high; }
};

inline constexpr int kResamples = 2000;
inline constexpr double kConfidence = 0.95;

/// With fewer scenes a resampled interval says nothing.
inline constexpr std::size_t kFewestScenes = 5;

/// How often each scene is in a resample -> the quantity; NaN where it is undefined.
using Statistic = std::function<double(std::span<const int> times_drawn)>;

/// Percentile bootstrap (Efron and Tibshirani, 1993, section 13.3) over scenes, because the steps
/// of one scene are correlated: `kResamples` times as many scenes as there are are drawn with
/// replacement. A resample for which the quantity is undefined widens the interval at both ends.
/// Nothing with fewer than kFewestScenes. Cost: kResamples calls.
std::optional<Interval> bootstrap(std::size_t scenes, const Statistic& statistic,
                                  std::uint64_t seed = 1);

/// sum(of) / sum(over), where each scene adds its share as often as it is drawn: the statistic of
/// means, rates and logarithms of geometric means.
Statistic ratio_of_sums(std::vector<double> of, std::vector<double> over);

}  // namespace conebench::results
