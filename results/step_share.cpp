#include "results/step_share.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "problems/error.h"
#include "results/tails.h"

namespace conebench::results {
namespace {

// The median times of the contenders, in the order of the ranking, on the problems of a scene.
struct SceneTimes {
  const SceneCost* cost;
  std::size_t problems = 0;
  std::vector<double> median_s;
};

std::vector<SceneTimes> times_of_scenes(const GroupNumbers& n, std::span<const SceneCost> costs,
                                        double tol) {
  const TimeTable shown = comparable(make_time_table(n.group().methods, tol));
  std::vector<SceneTimes> all;
  for (const SceneCost& cost : costs) {
    SceneTimes scene{.cost = &cost, .problems = 0, .median_s = {}};
    for (const Rank& line : n.ranking()) {
      std::vector<double> times_s;
      for (const auto& row : shown.rows) {
        if (row.problem.family == cost.family) times_s.push_back(row.time_s[n.place(line.solver)]);
      }
      scene.problems = times_s.size();
      if (!times_s.empty()) scene.median_s.push_back(order_statistic(times_s, 0.5));
    }
    if (scene.problems > 0) all.push_back(std::move(scene));
  }
  return all;
}

std::string with_name(const GroupNumbers& n, const SceneTimes& scene, std::size_t solver) {
  return fmt::format("{} ({})", tick(n.ranking()[solver].solver),
                     format_time(scene.median_s[solver]));
}

// A dot for each solver that solves half of a scene, at `value` of its median time.
Plot dots_of(const GroupNumbers& n, std::span<const SceneTimes> scenes,
             const std::function<double(double time_s, double rest_s)>& value) {
  Plot plot{.id = "step",
            .title = "What a simulation step would be with each solver",
            .reading =
                "The solver's median time on the scene's problems, with the rest of the step "
                "(contacts, transfer, assembly), which is the same for all. At 100 % the "
                "solver is all that matters; no dot: it fails on half of them.",
            .mark = Mark::kDots,
            .y = {.label = "scene", .quantity = Quantity::kName}};
  for (const SceneTimes& scene : scenes) plot.y.categories.push_back(scene.cost->family);
  const auto solvers = static_cast<double>(n.ranking().size());
  for (const Rank& line : n.ranking()) {
    const std::size_t s = plot.series.size();
    plot.series.push_back({.name = line.solver, .style = s});
    // Dots of one row lie a little apart.
    const double aside = 0.7 * ((static_cast<double>(s) + 0.5) / solvers - 0.5);
    for (std::size_t row = 0; row < scenes.size(); ++row) {
      const double time_s = scenes[row].median_s[s];
      if (!std::isfinite(time_s)) continue;
      plot.series.back().points.push_back({.x = value(time_s, scenes[row].cost->other_per_step_s()),
                                           .y = static_cast<double>(row) + aside});
    }
  }
  return plot;
}

Plot share_plot(const GroupNumbers& n, std::span<const SceneTimes> scenes, double tol) {
  Plot plot =
      dots_of(n, scenes, [](double time_s, double rest_s) { return time_s / (time_s + rest_s); });
  plot.choice = fmt::format("share, eta <= {:.0e}", tol);
  plot.x = {.label = "solver's share of the step [%]", .quantity = Quantity::kShare};
  return plot;
}

Plot length_plot(const GroupNumbers& n, std::span<const SceneTimes> scenes, double tol) {
  Plot plot = dots_of(n, scenes, [](double time_s, double rest_s) { return time_s + rest_s; });
  plot.choice = fmt::format("length, eta <= {:.0e}", tol);
  std::vector<double> lengths;
  for (const Series& series : plot.series) {
    for (const PlotPoint& point : series.points) lengths.push_back(point.x);
  }
  plot.x = log_axis("length of a step [s]", Quantity::kTime, lengths);
  return plot;
}

}  // namespace

SceneCost scene_cost_from_json(const nlohmann::json& summary, const std::string& where) {
  try {
    SceneCost cost{.family = summary.at("engine").get<std::string>() + "/" +
                             summary.at("scene").get<std::string>(),
                   .steps = summary.at("steps"),
                   .solve_s = summary.at("solve_s"),
                   .other_s = 0.0,
                   .solver = summary.at("solver")};
    cost.other_s = summary.contains("engine_s") ? summary.at("engine_s").get<double>()
                                                : summary.at("assembly_s").get<double>() +
                                                      summary.at("transfer_s").get<double>();
    problems::require(cost.steps > 0, where, "the run made ", cost.steps, " steps, expected some");
    return cost;
  } catch (const nlohmann::json::exception& error) {
    throw problems::InputError(where, error.what());
  }
}

std::vector<Plot> step_plots(const GroupNumbers& n, std::span<const SceneCost> costs) {
  std::vector<double> tolerances = {n.group().tolerances().front()};
  if (n.tol() < tolerances.front()) tolerances.push_back(n.tol());
  std::vector<Plot> plots;
  for (const double tol : tolerances) {
    const auto scenes = times_of_scenes(n, costs, tol);
    if (scenes.empty()) return {};
    plots.push_back(share_plot(n, scenes, tol));
    plots.push_back(length_plot(n, scenes, tol));
  }
  return plots;
}

Block step_block(const GroupNumbers& n, std::span<const SceneCost> costs) {
  TextTable table({"scene", "problems", "rest of the step", "quickest solver", "slowest solver",
                   "step, slowest over quickest"});
  const double tol = n.group().tolerances().front();
  for (const SceneTimes& scene : times_of_scenes(n, costs, tol)) {
    const double rest_s = scene.cost->other_per_step_s();
    std::vector<std::size_t> solving;
    for (std::size_t s = 0; s < scene.median_s.size(); ++s) {
      if (std::isfinite(scene.median_s[s])) solving.push_back(s);
    }
    std::vector<std::string> row = {
        scene.cost->family, fmt::format("{}", scene.problems), format_time(rest_s), "-", "-", "-"};
    if (!solving.empty()) {
      const auto [quickest, slowest] = std::minmax_element(
          solving.begin(), solving.end(),
          [&](std::size_t a, std::size_t b) { return scene.median_s[a] < scene.median_s[b]; });
      row[3] = with_name(n, scene, *quickest);
      row[4] = with_name(n, scene, *slowest);
      row[5] = fmt::format(
          "{:.1f}", (scene.median_s[*slowest] + rest_s) / (scene.median_s[*quickest] + rest_s));
    }
    table.add(std::move(row));
  }
  if (table.rows().size() == 1) return {};
  return {
      "A step, with the quickest and the slowest solver",
      {std::move(table)},
      fmt::format("Medians, to eta <= {:.0e}, of the solvers that solve half of the scene's "
                  "problems or more. *rest of the step*: measured in a run of the engine, which "
                  "is one run on one machine.",
                  tol)};
}

}  // namespace conebench::results
