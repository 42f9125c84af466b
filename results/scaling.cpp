#include "results/scaling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "results/tails.h"

namespace conebench::results {
namespace {

// Of one solver: the times of the problems in each class of sizes, failures infinite.
using Classes = std::map<int, std::vector<double>>;

int class_of(int cones) { return static_cast<int>(std::floor(std::log2(std::max(1, cones)))); }

std::vector<PlotPoint> medians(const Classes& classes) {
  std::vector<PlotPoint> points;
  for (const auto& [octave, times_s] : classes) {
    const double median_s = order_statistic(times_s, 0.5);
    // The class holds sizes from 2^k to 2^(k+1).
    if (std::isfinite(median_s)) points.push_back({.x = std::exp2(octave + 0.5), .y = median_s});
  }
  return points;
}

}  // namespace

std::optional<double> power_of(std::span<const double> x, std::span<const double> y,
                               double least_span) {
  if (x.empty()) return {};
  const auto [low, high] = std::minmax_element(x.begin(), x.end());
  if (!(*low > 0.0) || *high < least_span * *low) return {};
  double sx = 0.0, sy = 0.0, sxx = 0.0, sxy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double lx = std::log(x[i]), ly = std::log(y[i]);
    sx += lx, sy += ly, sxx += lx * lx, sxy += lx * ly;
  }
  const auto n = static_cast<double>(x.size());
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

Scaling scaling(const GroupNumbers& n) {
  Plot plot{.id = "scaling",
            .title = fmt::format("Time to eta <= {:.0e} against the size of the problem", n.tol()),
            .reading =
                "Medians of classes of sizes a factor of 2 wide. A failure is infinite: a "
                "curve has no point where a solver fails on half of a class. Problems of "
                "one size still differ.",
            .mark = Mark::kLines};
  TextTable table({"solver", "time grows as cones^", "over", "largest solved [cones]"});
  std::vector<double> cones, times_s;
  for (const Rank& line : n.ranking()) {
    const std::size_t s = n.place(line.solver);
    Classes classes;
    std::vector<double> sizes, solved_s;
    int largest = 0;
    for (const auto& row : n.shown().rows) {
      classes[class_of(row.problem.cones)].push_back(row.time_s[s]);
      if (!std::isfinite(row.time_s[s])) continue;
      sizes.push_back(std::max(1, row.problem.cones));
      solved_s.push_back(std::max(row.time_s[s], kShortestTime_s));
      largest = std::max(largest, row.problem.cones);
    }
    plot.series.push_back(
        {.name = line.solver, .style = plot.series.size(), .points = medians(classes)});
    for (const PlotPoint& point : plot.series.back().points) {
      cones.push_back(point.x);
      times_s.push_back(point.y);
    }
    const auto power = power_of(sizes, solved_s);
    table.add({tick(line.solver), power ? fmt::format("{:.2f}", *power) : "-",
               fmt::format("{}", sizes.size()), largest > 0 ? fmt::format("{}", largest) : "-"});
  }
  plot.x = log_axis("cones [-]", Quantity::kCount, cones);
  plot.y = log_axis("solver time [s]", Quantity::kTime, times_s);
  return {std::move(plot),
          {"How time grows with size",
           {std::move(table)},
           "Least squares of the logarithms over the problems that the solver solves (*over*), "
           "which are other problems for each solver: large ones that it fails on are missing. A "
           "dash: sizes within a factor of 4."}};
}

}  // namespace conebench::results
