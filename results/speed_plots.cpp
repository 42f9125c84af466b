#include "results/speed_plots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "results/text.h"

namespace conebench::results {
namespace {

Axis share_axis(const char* label) {
  return {.label = label, .quantity = Quantity::kShare, .scale = Scale::kLinear};
}

std::string choice_of(double tol) { return fmt::format("eta <= {:.0e}", tol); }

std::size_t index_of(const TimeTable& table, const std::string& solver) {
  const auto found = std::find(table.solvers.begin(), table.solvers.end(), solver);
  return static_cast<std::size_t>(found - table.solvers.begin());
}

std::vector<std::optional<double>> times_of(const TimeTable& table, const std::string& solver) {
  const std::size_t s = index_of(table, solver);
  std::vector<std::optional<double>> times_s;
  for (const auto& row : table.rows) {
    times_s.push_back(row.status[s] ? std::optional(row.time_s[s]) : std::nullopt);
  }
  return times_s;
}

std::string count_of(const Rank& line) { return fmt::format("{}/{}", line.solved, line.problems); }

// One series a solver, best first; `points` is asked for by the index in the table.
std::vector<Series> series_of(const TimeTable& table, std::span<const Rank> ranking,
                              const std::function<std::vector<PlotPoint>(std::size_t)>& points) {
  std::vector<Series> series;
  for (const Rank& line : ranking) {
    series.push_back({.name = line.solver,
                      .note = count_of(line),
                      .style = series.size(),
                      .points = points(index_of(table, line.solver))});
  }
  return series;
}

std::vector<double> values_of(const std::vector<std::vector<Step>>& curves) {
  std::vector<double> values;
  for (const auto& curve : curves) {
    for (const Step& step : curve) values.push_back(step.value);
  }
  return values;
}

Plot distribution_plot(const GroupNumbers& n, const std::vector<std::vector<Step>>& curves,
                       const std::string& choice, const std::string& label) {
  Plot plot{.id = "ecdf",
            .choice = choice,
            .title = fmt::format("Problems solved to eta <= {:.0e} within a time", n.tol()),
            .reading =
                "The share of problems solved by then; a failure is never reached. Further "
                "left and higher is better. Does not depend on who is compared.",
            .mark = Mark::kSteps,
            .x = log_axis(label, Quantity::kTime, values_of(curves)),
            .y = share_axis("problems solved [% of all]")};
  plot.series = series_of(n.table(), n.ranking(),
                          [&](std::size_t s) { return points_of(curves[s], plot.x, plot.y); });
  return plot;
}

}  // namespace

Plot profile_plot(const TimeTable& table, std::span<const Rank> ranking) {
  const auto profiles = performance_profiles(table);
  double largest = 2.0;
  for (const auto& profile : profiles) {
    if (!profile.empty()) largest = std::max(largest, profile.back().ratio);
  }
  const double octaves = std::ceil(std::log2(std::min(largest, kLargestRatio)) + 0.25);
  Plot plot{.id = "profile",
            .choice = choice_of(table.tol),
            .title = fmt::format("Performance profile, {} problems",
                                 ranking.empty() ? 0 : ranking.front().problems),
            .reading =
                "The share of problems on which a solver was within a factor of the fastest "
                "one. At 1: how often it was the fastest; at the right: how many it solves "
                "at all. Depends on who is compared: hide a solver in the page, and it is made "
                "anew for the others.",
            .mark = Mark::kSteps,
            .x = {.label = "time over the fastest solver's [-]",
                  .quantity = Quantity::kRatio,
                  .scale = Scale::kLog2,
                  .low = 1.0,
                  .high = std::exp2(octaves)},
            .y = share_axis("problems solved [% of all]")};
  plot.series = series_of(table, ranking, [&](std::size_t s) {
    std::vector<Step> steps;
    for (const ProfileStep& step : profiles[s]) steps.push_back({step.ratio, step.share});
    std::vector<PlotPoint> points = points_of(steps, plot.x, plot.y);
    if (points.empty() || points.front().x > 1.0) points.insert(points.begin(), {.x = 1.0});
    return points;
  });
  for (Series& series : plot.series) series.times_s = times_of(table, series.name);
  return plot;
}

std::vector<Plot> profile_plots(const GroupNumbers& n) {
  std::vector<Plot> plots;
  for (const double tol : n.group().tolerances()) {
    const TimeTable table = tol == n.tol() ? n.table() : make_time_table(n.group().methods, tol);
    // Colours stay those of the ranking at the group's own tolerance.
    const auto here = rank(table);
    std::vector<Rank> ranking;
    for (const Rank& line : n.ranking()) {
      ranking.push_back(*std::find_if(here.begin(), here.end(), [&](const Rank& other) {
        return other.solver == line.solver;
      }));
    }
    plots.insert(plots.begin(), profile_plot(table, ranking));
  }
  return plots;
}

Plot tolerance_plot(const GroupNumbers& n) {
  const SolvedCounts counts = solved_counts(n.group().methods, n.tol());
  Plot plot{.id = "tolerance",
            .title = "Problems solved, against the tolerance asked",
            .reading =
                "Every answer is judged at each tolerance, and must be within the time "
                "limit. A curve that falls to the right: easy to come near, hard to meet.",
            .mark = Mark::kLines,
            .x = {.label = "tolerance on eta [-]",
                  .quantity = Quantity::kEta,
                  .scale = Scale::kLog10,
                  .low = counts.tolerances.back(),
                  .high = std::max(counts.tolerances.front(), 10 * counts.tolerances.back()),
                  .falling = true},
            .y = share_axis("problems solved [% of all]")};
  plot.series = series_of(n.table(), n.ranking(), [&](std::size_t s) {
    std::vector<PlotPoint> points;
    for (std::size_t k = 0; k < counts.tolerances.size(); ++k) {
      points.push_back(
          {.x = counts.tolerances[k],
           .y = static_cast<double>(counts.solved[s][k]) / std::max(1, counts.problems)});
    }
    return points;
  });
  return plot;
}

std::vector<Plot> time_plots(const GroupNumbers& n) {
  return {
      distribution_plot(n, time_distributions(n.table()), "time", "solver time [s]"),
      distribution_plot(n, data_profiles(n.table()), "time per cone", "solver time per cone [s]")};
}

Plot missed_plot(const GroupNumbers& n) {
  const auto curves = time_distributions(n.table());
  double least = 1.0;  // that is left by a solver which leaves some
  for (const auto& curve : curves) {
    const double left = curve.empty() ? 1.0 : 1.0 - curve.back().share;
    if (left > 0.0) least = std::min(least, left);
  }
  Plot plot{.id = "missed",
            .title = fmt::format("Problems not solved to eta <= {:.0e} by a deadline", n.tol()),
            .reading =
                "The slow end, which decides a frame rate: what is left at a deadline, "
                "failures included. Lower is better; a flat end is what a solver never "
                "solves, and a curve that leaves below has none left.",
            .mark = Mark::kSteps,
            .x = log_axis("deadline on the solver time [s]", Quantity::kTime, values_of(curves)),
            .y = {.label = "problems missed [% of all]",
                  .quantity = Quantity::kShare,
                  .scale = Scale::kLog10,
                  .low = std::pow(10.0, std::floor(std::log10(0.9 * least))),
                  .high = 1.0}};
  plot.series = series_of(n.table(), n.ranking(), [&](std::size_t s) {
    std::vector<PlotPoint> points = {{.x = plot.x.low, .y = 1.0}};
    for (const Step& step : curves[s]) {
      points.push_back({.x = step.value, .y = std::max(1.0 - step.share, plot.y.low)});
    }
    return thinned(std::move(points), plot.x, plot.y);
  });
  return plot;
}

Plot solved_plot(const GroupNumbers& n) {
  Plot plot{.id = "solved",
            .title = fmt::format("Problems solved to a verified eta <= {:.0e}", n.tol()),
            .reading = n.scenes() < kFewestScenes
                           ? fmt::format("{} scenes are too few for intervals.", n.scenes())
                           : fmt::format("Lines: 95 % intervals over the {} scenes. Where two "
                                         "overlap widely, no order is claimed.",
                                         n.scenes()),
            .mark = Mark::kDots,
            .x = share_axis("problems solved [% of all]"),
            .y = {.label = "solver", .quantity = Quantity::kName}};
  for (const Rank& line : n.ranking()) {
    const auto row = static_cast<double>(plot.series.size());
    plot.y.categories.push_back(line.solver);
    plot.series.push_back(
        {.name = line.solver,
         .note = count_of(line),
         .style = plot.series.size(),
         .points = {{.x = static_cast<double>(line.solved) / std::max(1, line.problems),
                     .y = row,
                     .x_interval = n.share_interval(line.solver)}}});
  }
  return plot;
}

}  // namespace conebench::results
