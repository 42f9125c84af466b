#include "results/noise.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "results/profiles.h"
#include "results/tails.h"

namespace conebench::results {
namespace {

constexpr int kSplits = 1000;
constexpr double kShareInside = 0.95;

double log_median(std::vector<double> times_s) {
  return std::log(std::max(order_statistic(std::move(times_s), 0.5), kShortestTime_s));
}

// Of one task; `times_s` comes back shuffled. Which half gets the odd one is up to chance too.
double log_ratio_of_halves(std::vector<double>& times_s, std::mt19937_64& random) {
  std::shuffle(times_s.begin(), times_s.end(), random);
  const auto middle = times_s.begin() + static_cast<std::ptrdiff_t>(times_s.size() / 2);
  const double difference =
      log_median({times_s.begin(), middle}) - log_median({middle, times_s.end()});
  return random() % 2 == 0 ? difference : -difference;
}

}  // namespace

RepeatedTimes repeated_times(std::span<const Record> records, double tol) {
  RepeatedTimes times;
  for (const Record& record : records) {
    const double time_s = time_to_tolerance(record, tol);
    if (!std::isfinite(time_s)) continue;
    times[{contender(record), record.problem.content_sha256}].push_back(time_s);
  }
  for (auto& [task, of_task] : times) std::sort(of_task.begin(), of_task.end());
  return times;
}

std::optional<double> noise_floor(std::span<const std::vector<double>> times_s,
                                  std::uint64_t seed) {
  std::vector<std::vector<double>> tasks;
  std::copy_if(times_s.begin(), times_s.end(), std::back_inserter(tasks),
               [](const auto& of_task) { return of_task.size() >= 2; });
  if (tasks.empty()) return std::nullopt;

  std::mt19937_64 random(seed);
  std::vector<double> distances;
  for (int split = 0; split < kSplits; ++split) {
    double sum = 0.0;
    for (auto& of_task : tasks) sum += log_ratio_of_halves(of_task, random);
    distances.push_back(std::abs(sum) / static_cast<double>(tasks.size()));
  }
  return std::exp(order_statistic(std::move(distances), kShareInside));
}

}  // namespace conebench::results
