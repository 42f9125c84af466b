#include "results/bootstrap.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <utility>

#include "results/tails.h"

namespace conebench::results {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double limit(std::vector<double> values, double share, double undefined) {
  for (double& value : values) {
    if (std::isnan(value)) value = undefined;
  }
  return order_statistic(std::move(values), share);
}

}  // namespace

const std::string& scene_of(const ProblemId& problem) {
  return problem.family.empty() ? problem.content_sha256 : problem.family;
}

Scenes number_scenes(std::span<const std::string> scene_of_row) {
  Scenes scenes{.names = {scene_of_row.begin(), scene_of_row.end()}, .of_row = {}};
  std::sort(scenes.names.begin(), scenes.names.end());
  scenes.names.erase(std::unique(scenes.names.begin(), scenes.names.end()), scenes.names.end());
  scenes.of_row.reserve(scene_of_row.size());
  for (const std::string& scene : scene_of_row) {
    const auto found = std::lower_bound(scenes.names.begin(), scenes.names.end(), scene);
    scenes.of_row.push_back(static_cast<std::size_t>(found - scenes.names.begin()));
  }
  return scenes;
}

std::optional<Interval> bootstrap(std::size_t scenes, const Statistic& statistic,
                                  std::uint64_t seed) {
  if (scenes < kFewestScenes) return std::nullopt;
  std::mt19937_64 random(seed);
  std::uniform_int_distribution<std::size_t> draw(0, scenes - 1);
  std::vector<double> values;
  for (int sample = 0; sample < kResamples; ++sample) {
    std::vector<int> times_drawn(scenes, 0);
    for (std::size_t i = 0; i < scenes; ++i) ++times_drawn[draw(random)];
    values.push_back(statistic(times_drawn));
  }
  constexpr double kTail = (1.0 - kConfidence) / 2.0;
  return Interval{limit(values, kTail, -kInfinity), limit(values, 1.0 - kTail, kInfinity)};
}

Statistic ratio_of_sums(std::vector<double> of, std::vector<double> over) {
  return [of = std::move(of), over = std::move(over)](std::span<const int> times_drawn) {
    double sum = 0.0, weight = 0.0;
    for (std::size_t scene = 0; scene < times_drawn.size(); ++scene) {
      sum += times_drawn[scene] * of[scene];
      weight += times_drawn[scene] * over[scene];
    }
    return weight > 0.0 ? sum / weight : std::nan("");
  };
}

}  // namespace conebench::results
