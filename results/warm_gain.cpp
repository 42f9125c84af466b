#include "results/warm_gain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace conebench::results {
namespace {

// Times by problem content, of one contender.
using Times = std::map<std::string, double>;

std::map<std::string, Times> times_by_solver(const TimeTable& table) {
  std::map<std::string, Times> times;
  for (const auto& row : table.rows) {
    for (std::size_t s = 0; s < table.solvers.size(); ++s) {
      if (row.status[s]) times[table.solvers[s]][row.problem.content_sha256] = row.time_s[s];
    }
  }
  return times;
}

std::map<std::string, std::string> scenes_of(const TimeTable& table) {
  std::map<std::string, std::string> scenes;
  for (const auto& row : table.rows) scenes[row.problem.content_sha256] = scene_of(row.problem);
  return scenes;
}

std::vector<Record> started_warm(const std::vector<Record>& records) {
  std::vector<Record> warm;
  for (const Record& record : records) {
    if (record.sequence.id.empty() || record.sequence.index > 0) warm.push_back(record);
  }
  return warm;
}

// "ipm" of "ipm after gs": the cold run has no donor.
std::string receiver_of(const std::string& name, const Group& group) {
  for (const Record& record : group.methods) {
    if (contender(record) == name) return record.solver;
  }
  return name;
}

double floored(double time_s) { return std::max(time_s, kShortestTime_s); }

WarmGain gain_of(const std::string& solver, const Times& cold, const Times& warm,
                 const std::map<std::string, std::string>& scenes) {
  WarmGain result{.solver = solver};
  std::map<std::string, std::pair<double, double>> sums;  // log ratio and count, by scene
  for (const auto& [sha, warm_s] : warm) {
    const auto found = cold.find(sha);
    if (found == cold.end()) continue;
    result.cold_solved += std::isfinite(found->second);
    result.warm_solved += std::isfinite(warm_s);
    if (!std::isfinite(found->second) || !std::isfinite(warm_s)) continue;
    ++result.both;
    auto& [log_ratio, count] = sums[scenes.at(sha)];
    log_ratio += std::log(floored(found->second) / floored(warm_s));
    count += 1.0;
  }
  if (result.both == 0) return result;
  std::vector<double> of, over;
  double total = 0.0;
  for (const auto& [scene, sum] : sums) {
    of.push_back(sum.first);
    over.push_back(sum.second);
    total += sum.first;
  }
  result.gain = std::exp(total / result.both);
  if (const auto i = bootstrap(of.size(), ratio_of_sums(of, over))) {
    result.interval = Interval{std::exp(i->low), std::exp(i->high)};
  }
  return result;
}

}  // namespace

const Group* cold_twin(const Group& warm, std::span<const Group> groups) {
  if (warm.settings.mode == "cold") return nullptr;
  Settings wanted = warm.settings;
  wanted.mode = "cold";
  for (const Group& group : groups) {
    if (group.settings == wanted && !group.methods.empty()) return &group;
  }
  return nullptr;
}

std::vector<WarmGain> warm_gains(const Group& cold, const Group& warm) {
  const TimeTable table = make_time_table(started_warm(warm.methods), warm.settings.tol);
  const auto cold_times = times_by_solver(make_time_table(cold.methods, cold.settings.tol));
  const auto scenes = scenes_of(table);
  std::vector<WarmGain> gains;
  for (const auto& [solver, times] : times_by_solver(table)) {
    const auto found = cold_times.find(receiver_of(solver, warm));
    if (found != cold_times.end()) gains.push_back(gain_of(solver, found->second, times, scenes));
  }
  return gains;
}

Plot warm_plot(std::span<const WarmGain> gains, std::span<const Rank> ranking) {
  std::vector<double> values = {0.9, 1.1};
  Plot plot{.id = "warm",
            .title = "How many times faster from the answer to the step before",
            .reading =
                "Cold time over warm time, geometric mean over the problems solved from "
                "both starts. Right of 1: the warm start pays. Lines: 95 % intervals over "
                "scenes.",
            .mark = Mark::kDots,
            .y = {.label = "solver", .quantity = Quantity::kName}};
  for (std::size_t place = 0; place < ranking.size(); ++place) {
    const auto gain = std::find_if(gains.begin(), gains.end(), [&](const WarmGain& g) {
      return g.solver == ranking[place].solver && g.gain;
    });
    if (gain == gains.end()) continue;
    const auto row = static_cast<double>(plot.series.size());
    plot.y.categories.push_back(gain->solver);
    plot.series.push_back({.name = gain->solver,
                           .style = place,
                           .points = {{.x = *gain->gain, .y = row, .x_interval = gain->interval}}});
    values.push_back(1.05 * *gain->gain);
    values.push_back(0.95 * *gain->gain);
    if (gain->interval) values.insert(values.end(), {gain->interval->low, gain->interval->high});
  }
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  plot.x = {.label = "cold time over warm time [-]",
            .quantity = Quantity::kRatio,
            .scale = Scale::kLog2,
            .low = std::exp2(std::floor(std::log2(std::max(*low, 1.0 / kLargestRatio)))),
            .high = std::exp2(std::ceil(std::log2(std::min(*high, kLargestRatio))))};
  return plot;
}

Block warm_block(std::span<const WarmGain> gains, const Settings& warm) {
  if (gains.empty()) return {};
  TextTable table({"solver", "times faster", "95 %", "over", "solved cold", "solved warm"});
  for (const WarmGain& g : gains) {
    table.add(
        {tick(g.solver), g.gain ? fmt::format("{:.3g}", *g.gain) : "-",
         g.interval ? fmt::format("{:.3g} to {:.3g}", g.interval->low, g.interval->high) : "-",
         fmt::format("{}", g.both), fmt::format("{}", g.cold_solved),
         fmt::format("{}", g.warm_solved)});
  }
  return {"Gain of a warm start",
          {std::move(table)},
          fmt::format("Mode *{}* against the same solver from r = 0, under the same rules. *over*: "
                      "problems solved from both starts. The first step of a sequence is left out.",
                      warm.mode)};
}

}  // namespace conebench::results
