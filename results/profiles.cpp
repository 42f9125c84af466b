#include "results/profiles.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "results/shares.h"

namespace conebench::results {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

bool run_by_all(const TimeTable::Row& row) {
  return std::all_of(row.status.begin(), row.status.end(),
                     [](const auto& status) { return status.has_value(); });
}

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

// Of a table whose rows are all comparable.
std::vector<std::vector<ProfileStep>> profiles_of(const TimeTable& shown) {
  std::vector<std::vector<ProfileStep>> profiles(shown.solvers.size());
  for (std::size_t s = 0; s < shown.solvers.size(); ++s) {
    std::vector<double> ratios;
    for (const auto& row : shown.rows) {
      if (std::isfinite(row.time_s[s])) ratios.push_back(floored(row.time_s[s]) / fastest_of(row));
    }
    for (const Step& step : cumulative_shares(std::move(ratios), shown.rows.size())) {
      profiles[s].push_back({.ratio = step.value, .share = step.share});
    }
  }
  return profiles;
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

std::string contender(const std::string& solver, const std::string& donor) {
  return donor.empty() ? solver : solver + " after " + donor;
}

Outcome outcome_of(std::span<const Record* const> repetitions, double t) {
  std::vector<double> times_s;
  const Record* last = repetitions.front();
  for (const Record* record : repetitions) {
    times_s.push_back(time_to_tolerance(*record, t));
    if (record->repetition >= last->repetition) last = record;
  }
  const auto middle = times_s.begin() + static_cast<std::ptrdiff_t>(times_s.size() / 2);
  std::nth_element(times_s.begin(), middle, times_s.end());  // infinities sort last
  return {.time_s = *middle, .status = last->status};
}

TimeTable make_time_table(std::span<const Record> records, double t) {
  std::map<std::string, ProblemId> problems;  // by content
  std::map<std::pair<std::string, std::string>, std::vector<const Record*>> runs;
  std::set<std::string> solvers;
  for (const Record& record : records) {
    const std::string solver = contender(record);
    solvers.insert(solver);
    problems.emplace(record.problem.content_sha256, record.problem);
    runs[{record.problem.content_sha256, solver}].push_back(&record);
  }

  TimeTable table{.tol = t, .solvers = {solvers.begin(), solvers.end()}, .rows = {}};
  for (const auto& [sha, problem] : problems) {
    TimeTable::Row row{.problem = problem, .time_s = {}, .status = {}};
    for (const std::string& solver : table.solvers) {
      const auto found = runs.find({sha, solver});
      const bool ran = found != runs.end();
      const Outcome outcome = ran ? outcome_of(found->second, t) : Outcome{.time_s = kNever};
      row.time_s.push_back(outcome.time_s);
      row.status.push_back(ran ? std::optional(outcome.status) : std::nullopt);
    }
    table.rows.push_back(std::move(row));
  }
  std::sort(table.rows.begin(), table.rows.end(), before);
  return table;
}

bool before(const TimeTable::Row& a, const TimeTable::Row& b) {
  const auto key = [](const ProblemId& id) {
    return std::tie(id.family, id.name, id.content_sha256);
  };
  return key(a.problem) < key(b.problem);
}

TimeTable comparable(const TimeTable& table) {
  TimeTable shown{.tol = table.tol, .solvers = table.solvers, .rows = {}};
  std::copy_if(table.rows.begin(), table.rows.end(), std::back_inserter(shown.rows), run_by_all);
  return shown;
}

std::vector<int> not_run(const TimeTable& table) {
  std::vector<int> counts(table.solvers.size(), 0);
  for (const auto& row : table.rows) {
    for (std::size_t s = 0; s < counts.size(); ++s) counts[s] += !row.status[s].has_value();
  }
  return counts;
}

TimeTable without_solver(const TimeTable& table, std::size_t solver) {
  const auto place = static_cast<std::ptrdiff_t>(solver);
  TimeTable rest = table;
  rest.solvers.erase(rest.solvers.begin() + place);
  for (auto& row : rest.rows) {
    row.time_s.erase(row.time_s.begin() + place);
    row.status.erase(row.status.begin() + place);
  }
  return rest;
}

std::vector<std::vector<ProfileStep>> performance_profiles(const TimeTable& table) {
  return profiles_of(comparable(table));
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
  const TimeTable shown = comparable(table);
  const auto left_out = not_run(table);
  const auto profiles = profiles_of(shown);
  const auto common = common_rows(shown);
  std::vector<Rank> ranking;
  for (std::size_t s = 0; s < shown.solvers.size(); ++s) {
    Rank line;
    line.solver = shown.solvers[s];
    line.problems = static_cast<int>(shown.rows.size());
    line.not_run = left_out[s];
    line.area = profile_area(profiles[s]);
    for (const auto& row : shown.rows) {
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
