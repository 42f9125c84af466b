#include "results/profiles.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace conebench::results {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

// The slower middle one of an even number; infinities sort last.
double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

struct Runs {
  std::vector<double> time_s;
  Status status = Status::kCrashed;
};

double floored(double time_s) { return std::max(time_s, kShortestTime_s); }

double fastest_of(const TimeTable::Row& row) {
  double best = kNever;
  for (const double t : row.time_s) best = std::min(best, floored(t));
  return best;
}

// Solvers without a single success say nothing about which problems are common.
std::vector<const TimeTable::Row*> common_rows(const TimeTable& table) {
  std::vector<bool> has_success(table.solvers.size(), false);
  for (const auto& row : table.rows) {
    for (std::size_t s = 0; s < row.time_s.size(); ++s) {
      if (std::isfinite(row.time_s[s])) has_success[s] = true;
    }
  }
  std::vector<const TimeTable::Row*> common;
  for (const auto& row : table.rows) {
    bool all = std::isfinite(fastest_of(row));
    for (std::size_t s = 0; s < row.time_s.size(); ++s) {
      if (has_success[s] && !std::isfinite(row.time_s[s])) all = false;
    }
    if (all) common.push_back(&row);
  }
  return common;
}

}  // namespace

double time_to_tolerance(const Record& record, double t) {
  if (!(record.eta <= t)) return kNever;
  double time_s = record.setup_s + record.solve_s;
  const auto reached = std::find_if(record.curve.begin(), record.curve.end(),
                                    [t](const CurvePoint& p) { return p.eta <= t; });
  if (reached != record.curve.end()) time_s = reached->time_s;
  return time_s <= record.settings.time_limit_s ? time_s : kNever;
}

TimeTable make_time_table(std::span<const Record> records, double t) {
  TimeTable table{.tol = t, .solvers = {}, .rows = {}};
  std::map<std::string, ProblemId> problems;  // by content
  std::map<std::pair<std::string, std::string>, Runs> runs;
  for (const Record& record : records) {
    if (std::find(table.solvers.begin(), table.solvers.end(), record.solver) ==
        table.solvers.end()) {
      table.solvers.push_back(record.solver);
    }
    problems.emplace(record.problem.content_sha256, record.problem);
    Runs& task = runs[{record.problem.content_sha256, record.solver}];
    task.time_s.push_back(time_to_tolerance(record, t));
    task.status = record.status;
  }

  std::sort(table.solvers.begin(), table.solvers.end());
  for (const auto& [sha, problem] : problems) {
    TimeTable::Row row{.problem = problem, .time_s = {}, .status = {}};
    for (const std::string& solver : table.solvers) {
      const auto found = runs.find({sha, solver});
      const bool ran = found != runs.end();
      row.time_s.push_back(ran ? median(found->second.time_s) : kNever);
      row.status.push_back(ran ? std::optional(found->second.status) : std::nullopt);
    }
    table.rows.push_back(std::move(row));
  }
  std::sort(table.rows.begin(), table.rows.end(), [](const auto& a, const auto& b) {
    return std::tie(a.problem.family, a.problem.name) < std::tie(b.problem.family, b.problem.name);
  });
  return table;
}

std::vector<std::vector<ProfileStep>> performance_profiles(const TimeTable& table) {
  std::vector<std::vector<ProfileStep>> profiles(table.solvers.size());
  const double problems = static_cast<double>(table.rows.size());
  for (std::size_t s = 0; s < table.solvers.size(); ++s) {
    std::vector<double> ratios;
    for (const auto& row : table.rows) {
      if (std::isfinite(row.time_s[s])) ratios.push_back(floored(row.time_s[s]) / fastest_of(row));
    }
    std::sort(ratios.begin(), ratios.end());
    for (std::size_t i = 0; i < ratios.size(); ++i) {
      const bool last_of_its_ratio = i + 1 == ratios.size() || ratios[i + 1] > ratios[i];
      if (!last_of_its_ratio) continue;
      profiles[s].push_back({ratios[i], static_cast<double>(i + 1) / problems});
    }
  }
  return profiles;
}

double profile_area(std::span<const ProfileStep> profile) {
  const double width = std::log2(kLargestRatio);
  double area = 0.0, share = 0.0;
  for (const ProfileStep& step : profile) {
    area += (step.share - share) * std::max(0.0, width - std::log2(step.ratio));
    share = step.share;
  }
  return area / width;
}

std::optional<double> shifted_geometric_mean(std::span<const double> times_s) {
  if (times_s.empty()) return std::nullopt;
  double sum = 0.0;
  for (const double t : times_s) sum += std::log(t + kMeanShift_s);
  return std::exp(sum / static_cast<double>(times_s.size())) - kMeanShift_s;
}

std::vector<Rank> rank(const TimeTable& table) {
  const auto profiles = performance_profiles(table);
  const auto common = common_rows(table);
  std::vector<Rank> ranking;
  for (std::size_t s = 0; s < table.solvers.size(); ++s) {
    Rank line;
    line.solver = table.solvers[s];
    line.problems = static_cast<int>(table.rows.size());
    line.area = profile_area(profiles[s]);
    for (const auto& row : table.rows) {
      if (!std::isfinite(row.time_s[s])) continue;
      ++line.solved;
      if (floored(row.time_s[s]) <= fastest_of(row)) ++line.fastest;
    }
    std::vector<double> times_s;
    for (const auto* row : common) times_s.push_back(row->time_s[s]);
    line.common = static_cast<int>(common.size());
    if (line.solved > 0) line.common_mean_s = shifted_geometric_mean(times_s);
    ranking.push_back(std::move(line));
  }
  std::stable_sort(ranking.begin(), ranking.end(), [](const Rank& a, const Rank& b) {
    return std::tie(a.solved, a.area) > std::tie(b.solved, b.area);
  });
  return ranking;
}

}  // namespace conebench::results
