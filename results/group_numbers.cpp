#include "results/group_numbers.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace conebench::results {
namespace {

std::optional<Interval> inverse(const std::optional<Interval>& ratio) {
  if (!ratio) return {};
  return Interval{1.0 / ratio->high, 1.0 / ratio->low};
}

std::optional<Interval> negative(const std::optional<Interval>& difference) {
  if (!difference) return {};
  return Interval{-difference->high, -difference->low};
}

SolverPair turned_round(SolverPair pair) {
  std::swap(pair.first, pair.second);
  pair.share_difference = -pair.share_difference;
  pair.share_interval = negative(pair.share_interval);
  if (pair.time_ratio) pair.time_ratio = 1.0 / *pair.time_ratio;
  pair.time_interval = inverse(pair.time_interval);
  return pair;
}

// Of a pair: is the first shown to be the better one?
bool beats(const SolverPair& pair) {
  if (pair.told_apart_by_share()) return pair.share_difference > 0.0;
  return pair.told_apart_by_time() && *pair.time_ratio < 1.0;
}

}  // namespace

GroupNumbers::GroupNumbers(const Group& group)
    : group_(group),
      table_(make_time_table(group.methods, group.settings.tol)),
      shown_(comparable(table_)),
      ranking_(rank(table_)),
      pairs_(compare_pairs(table_, repeated_times(group.methods, group.settings.tol))) {
  std::set<std::string> names;
  for (const auto& row : shown_.rows) names.insert(scene_of(row.problem));
  scenes_ = names.size();
}

std::size_t GroupNumbers::place(const std::string& solver) const {
  const auto found = std::find(table_.solvers.begin(), table_.solvers.end(), solver);
  return static_cast<std::size_t>(found - table_.solvers.begin());
}

SolverPair GroupNumbers::pair(const std::string& first, const std::string& second) const {
  const auto found = std::find_if(pairs_.begin(), pairs_.end(), [&](const SolverPair& p) {
    return (p.first == first && p.second == second) || (p.first == second && p.second == first);
  });
  return found->first == first ? *found : turned_round(*found);
}

std::vector<std::string> GroupNumbers::not_told_apart_from(const std::string& solver) const {
  std::vector<std::string> names;
  for (const Rank& other : ranking_) {
    if (other.solver == solver || pair(solver, other.solver).told_apart()) continue;
    names.push_back(other.solver);
  }
  return names;
}

std::vector<std::string> GroupNumbers::not_beaten_by_best() const {
  std::vector<std::string> names;
  for (std::size_t i = 1; i < ranking_.size(); ++i) {
    if (!beats(pair(ranking_.front().solver, ranking_[i].solver))) {
      names.push_back(ranking_[i].solver);
    }
  }
  return names;
}

std::optional<Interval> GroupNumbers::share_interval(const std::string& solver) const {
  const std::size_t s = place(solver);
  std::map<std::string, std::pair<double, double>> sums;  // solved and all, by scene
  for (const auto& row : shown_.rows) {
    auto& [solved, all] = sums[scene_of(row.problem)];
    solved += std::isfinite(row.time_s[s]);
    all += 1.0;
  }
  std::vector<double> solved, all;
  for (const auto& [scene, sum] : sums) {
    solved.push_back(sum.first);
    all.push_back(sum.second);
  }
  return bootstrap(solved.size(), ratio_of_sums(solved, all));
}

}  // namespace conebench::results
