#include "results/told_apart.h"

#include <algorithm>
#include <cmath>

namespace conebench::results {
namespace {

// Sums over the rows of a scene.
struct SceneSums {
  explicit SceneSums(std::size_t scenes)
      : rows(scenes, 0.0), solved_more(scenes, 0.0), both(scenes, 0.0), log_ratio(scenes, 0.0) {}
  std::vector<double> rows, solved_more, both, log_ratio;
};

double total(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum;
}

double log_time(double time_s) { return std::log(std::max(time_s, kShortestTime_s)); }

std::vector<const TimeTable::Row*> rows_of_both(const TimeTable& table, std::size_t first,
                                                std::size_t second) {
  std::vector<const TimeTable::Row*> rows;
  for (const auto& row : table.rows) {
    if (row.status[first] && row.status[second]) rows.push_back(&row);
  }
  return rows;
}

SceneSums sum_up(const std::vector<const TimeTable::Row*>& rows, std::size_t first,
                 std::size_t second) {
  std::vector<std::string> scene_of_row;
  for (const auto* row : rows) scene_of_row.push_back(scene_of(row->problem));
  const Scenes scenes = number_scenes(scene_of_row);
  SceneSums sums(scenes.names.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t scene = scenes.of_row[i];
    const double a = rows[i]->time_s[first], b = rows[i]->time_s[second];
    sums.rows[scene] += 1.0;
    sums.solved_more[scene] += std::isfinite(a) - std::isfinite(b);
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    sums.both[scene] += 1.0;
    sums.log_ratio[scene] += log_time(a) - log_time(b);
  }
  return sums;
}

// Scenes without a problem that both solve say nothing about the ratio.
void keep_scenes_of_both(SceneSums& sums) {
  std::vector<double> both, log_ratio;
  for (std::size_t scene = 0; scene < sums.both.size(); ++scene) {
    if (sums.both[scene] == 0.0) continue;
    both.push_back(sums.both[scene]);
    log_ratio.push_back(sums.log_ratio[scene]);
  }
  sums.both = std::move(both);
  sums.log_ratio = std::move(log_ratio);
}

void set_noise(SolverPair& pair, const std::vector<const TimeTable::Row*>& rows,
               const RepeatedTimes& repeated) {
  for (const std::string& solver : {pair.first, pair.second}) {
    std::vector<std::vector<double>> times_s;
    for (const auto* row : rows) {
      const auto found = repeated.find({solver, row->problem.content_sha256});
      if (found != repeated.end()) times_s.push_back(found->second);
    }
    const auto floor = noise_floor(times_s);
    if (!floor) continue;
    pair.noise = pair.noise_is_measured ? std::max(pair.noise, *floor) : *floor;
    pair.noise_is_measured = true;
  }
}

}  // namespace

bool SolverPair::told_apart_by_share() const {
  return share_interval && !share_interval->holds(0.0);
}

bool SolverPair::told_apart_by_time() const {
  return time_interval && !time_interval->holds(1.0) &&
         (*time_ratio > noise || *time_ratio < 1.0 / noise);
}

SolverPair compare_pair(const TimeTable& table, const RepeatedTimes& repeated, std::size_t first,
                        std::size_t second) {
  const auto rows = rows_of_both(table, first, second);
  SceneSums sums = sum_up(rows, first, second);
  SolverPair pair{.first = table.solvers[first],
                  .second = table.solvers[second],
                  .problems = static_cast<int>(rows.size()),
                  .both_solved = static_cast<int>(total(sums.both))};
  if (rows.empty()) return pair;
  pair.share_difference = total(sums.solved_more) / total(sums.rows);
  pair.share_interval = bootstrap(sums.rows.size(), ratio_of_sums(sums.solved_more, sums.rows));
  if (pair.both_solved == 0) return pair;

  keep_scenes_of_both(sums);
  pair.time_ratio = std::exp(total(sums.log_ratio) / total(sums.both));
  pair.time_interval = bootstrap(sums.both.size(), ratio_of_sums(sums.log_ratio, sums.both));
  if (pair.time_interval) {
    pair.time_interval = {std::exp(pair.time_interval->low), std::exp(pair.time_interval->high)};
  }
  set_noise(pair, rows, repeated);
  return pair;
}

std::vector<SolverPair> compare_pairs(const TimeTable& table, const RepeatedTimes& repeated) {
  std::vector<SolverPair> pairs;
  for (std::size_t first = 0; first < table.solvers.size(); ++first) {
    for (std::size_t second = first + 1; second < table.solvers.size(); ++second) {
      pairs.push_back(compare_pair(table, repeated, first, second));
    }
  }
  return pairs;
}

}  // namespace conebench::results
