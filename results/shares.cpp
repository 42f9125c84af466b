#include "results/shares.h"

#include <algorithm>
#include <cmath>

namespace conebench::results {
namespace {

// `value` turns a time [s] on a problem into what the distribution is over.
template <class Value>
std::vector<std::vector<Step>> distributions(const TimeTable& table, const Value& value) {
  const TimeTable shown = comparable(table);
  std::vector<std::vector<Step>> all;
  for (std::size_t s = 0; s < shown.solvers.size(); ++s) {
    std::vector<double> values;
    for (const auto& row : shown.rows) values.push_back(value(row.time_s[s], row.problem));
    all.push_back(cumulative_shares(std::move(values), shown.rows.size()));
  }
  return all;
}

}  // namespace

std::vector<Step> cumulative_shares(std::vector<double> values, std::size_t count) {
  std::erase_if(values, [](double value) { return !std::isfinite(value); });
  std::sort(values.begin(), values.end());
  std::vector<Step> steps;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool last_of_its_value = i + 1 == values.size() || values[i + 1] > values[i];
    if (!last_of_its_value) continue;
    steps.push_back({values[i], static_cast<double>(i + 1) / static_cast<double>(count)});
  }
  return steps;
}

std::vector<std::vector<Step>> time_distributions(const TimeTable& table) {
  return distributions(table, [](double time_s, const ProblemId&) { return time_s; });
}

std::vector<std::vector<Step>> data_profiles(const TimeTable& table) {
  return distributions(table, [](double time_s, const ProblemId& problem) {
    return time_s / std::max(1, problem.cones);
  });
}

std::vector<double> tolerance_ladder(double tol) {
  std::vector<double> ladder;
  for (int decade = 1; decade < 300; ++decade) {
    const double step = std::pow(10.0, -decade);
    if (step <= tol * 1.001) break;  // 1e-8 as somebody typed it, and as pow() gives it
    ladder.push_back(step);
  }
  ladder.push_back(tol);
  return ladder;
}

SolvedCounts solved_counts(std::span<const Record> records, double tol) {
  std::vector<TimeTable> tables;
  for (const double t : tolerance_ladder(tol)) {
    tables.push_back(comparable(make_time_table(records, t)));
  }
  return solved_counts(tables);
}

SolvedCounts solved_counts(std::span<const TimeTable> tables) {
  SolvedCounts counts{.tolerances = {},
                      .solvers = tables.front().solvers,
                      .solved = {},
                      .problems = static_cast<int>(tables.front().rows.size())};
  counts.solved.resize(counts.solvers.size());
  for (const TimeTable& table : tables) {
    counts.tolerances.push_back(table.tol);
    for (std::size_t s = 0; s < counts.solvers.size(); ++s) {
      counts.solved[s].push_back(static_cast<int>(
          std::count_if(table.rows.begin(), table.rows.end(),
                        [s](const auto& row) { return std::isfinite(row.time_s[s]); })));
    }
  }
  return counts;
}

}  // namespace conebench::results
