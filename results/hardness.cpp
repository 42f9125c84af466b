#include "results/hardness.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace conebench::results {
namespace {

// Share of failures, time of the quickest.
std::pair<double, double> hardness(const TimeTable::Row& row) {
  int ran = 0, failed = 0;
  double quickest_s = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < row.time_s.size(); ++s) {
    if (!row.status[s]) continue;
    ++ran;
    failed += !std::isfinite(row.time_s[s]);
    quickest_s = std::min(quickest_s, row.time_s[s]);
  }
  return {static_cast<double>(failed) / std::max(1, ran), quickest_s};
}

}  // namespace

std::vector<std::size_t> hardest_first(const TimeTable& table) {
  std::vector<std::pair<double, double>> keys;
  for (const auto& row : table.rows) keys.push_back(hardness(row));
  std::vector<std::size_t> order(table.rows.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return keys[a] > keys[b]; });
  return order;
}

}  // namespace conebench::results
