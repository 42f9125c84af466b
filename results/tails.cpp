#include "results/tails.h"

#include <algorithm>
#include <cmath>

namespace conebench::results {
namespace {

// p n is a whole number up to rounding: 0.07 * 100 must not become the 8th.
constexpr double kRounding = 1e-9;

std::size_t place(std::size_t count, double p) {
  const double rank = std::ceil(p * static_cast<double>(count) - kRounding);
  return static_cast<std::size_t>(std::clamp(rank, 1.0, static_cast<double>(count))) - 1;
}

}  // namespace

double order_statistic(std::vector<double> values, double p) {
  const auto wanted = values.begin() + static_cast<std::ptrdiff_t>(place(values.size(), p));
  std::nth_element(values.begin(), wanted, values.end());
  return *wanted;
}

std::optional<Tails> tails(std::span<const double> times_s) {
  if (times_s.empty()) return std::nullopt;
  std::vector<double> sorted(times_s.begin(), times_s.end());
  std::sort(sorted.begin(), sorted.end());
  const auto at = [&](double p) { return sorted[place(sorted.size(), p)]; };
  const auto failures =
      std::count_if(sorted.begin(), sorted.end(), [](double t) { return !std::isfinite(t); });
  return Tails{.p50 = at(0.5),
               .p90 = at(0.9),
               .p99 = at(0.99),
               .p99_9 = at(0.999),
               .max = sorted.back(),
               .count = sorted.size(),
               .failures = static_cast<std::size_t>(failures)};
}

ResidualMean residual_mean(std::span<const Record> records) {
  ResidualMean result;
  std::vector<double> logs;
  for (const Record& record : records) {
    if (record.solved()) {
      logs.push_back(std::log(std::max(record.eta, kEtaFloor)));
    } else {
      ++result.failed;
      if (!std::isfinite(record.eta)) ++result.unknown;
    }
    if (std::isfinite(record.eta)) result.worst = std::max(record.eta, result.worst.value_or(0.0));
  }
  result.solved = logs.size();
  if (logs.empty()) return result;
  std::sort(logs.begin(), logs.end());  // the sum shall not depend on the order of the records
  double sum = 0.0;
  for (const double value : logs) sum += value;
  result.mean = std::exp(sum / static_cast<double>(logs.size()));
  return result;
}

}  // namespace conebench::results
