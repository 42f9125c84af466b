#include "results/anytime.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "results/tails.h"

namespace conebench::results {
namespace {

constexpr int kTimesPerDecade = 12;
constexpr double kLowestEta = 1e-16, kGridStart_s = 1e-5;

double start_eta(const Record& record) {
  return std::isfinite(record.guess_eta) ? record.guess_eta : 1.0;
}

std::vector<double> grid(double last_s) {
  std::vector<double> times_s;
  for (int k = 0;; ++k) {
    times_s.push_back(kGridStart_s * std::pow(10.0, static_cast<double>(k) / kTimesPerDecade));
    if (times_s.back() >= last_s) return times_s;
  }
}

// By contender, of each of its records the eta held at the times.
using Held = std::map<std::string, std::vector<std::vector<double>>>;

Held held_by(const GroupNumbers& n, std::span<const double> times_s) {
  std::set<std::string> shown;
  for (const auto& row : n.shown().rows) shown.insert(row.problem.content_sha256);
  Held held;
  for (const Record& record : n.group().methods) {
    if (!shown.contains(record.problem.content_sha256)) continue;
    held[contender(record)].push_back(eta_held(record, times_s));
  }
  return held;
}

std::vector<PlotPoint> quantile_curve(const std::vector<std::vector<double>>& held,
                                      std::span<const double> times_s, double p) {
  std::vector<PlotPoint> points;
  for (std::size_t t = 0; t < times_s.size(); ++t) {
    std::vector<double> etas;
    for (const auto& of_record : held) etas.push_back(of_record[t]);
    if (etas.empty()) break;
    points.push_back({.x = times_s[t], .y = std::max(order_statistic(etas, p), kLowestEta)});
  }
  return points;
}

double longest_time_s(const GroupNumbers& n) {
  double longest = 1e-3;
  for (const Record& record : n.group().methods) {
    longest = std::max(longest, record.setup_s + record.solve_s);
  }
  return std::min(longest, n.group().settings.time_limit_s);
}

}  // namespace

std::vector<double> eta_held(const Record& record, std::span<const double> times_s) {
  const double returned = std::isnan(record.eta) ? Record::kUnknown : record.eta;
  const double end_s = record.setup_s + record.solve_s;
  std::vector<double> held;
  double best = Record::kUnknown;
  std::size_t next = 0;
  for (const double time_s : times_s) {
    for (; next < record.curve.size() && record.curve[next].time_s <= time_s; ++next) {
      best = std::min(best, record.curve[next].eta);
    }
    if (record.curve.empty() && end_s <= time_s) best = returned;
    held.push_back(std::min(std::max(best, returned), start_eta(record)));
  }
  return held;
}

std::vector<CurvePoint> best_so_far(const Record& record, double least_gain) {
  std::vector<CurvePoint> points;
  double best = Record::kUnknown;
  for (const CurvePoint& point : record.curve) {
    const bool last = &point == &record.curve.back();
    best = std::min(best, point.eta);
    if (!std::isfinite(best)) continue;
    if (points.empty() || last || best * least_gain <= points.back().eta) {
      points.push_back({.time_s = point.time_s, .iteration = point.iteration, .eta = best});
    }
  }
  return points;
}

std::vector<Plot> anytime_plots(const GroupNumbers& n) {
  const std::vector<double> times_s = grid(longest_time_s(n));
  const Held held = held_by(n, times_s);
  std::vector<Plot> plots;
  for (const auto& [choice, p] : {std::pair{"median problem", 0.5}, {"9 problems in 10", 0.9}}) {
    Plot plot{.id = "anytime",
              .choice = choice,
              .title = "Accuracy held after a time",
              .reading =
                  "What an engine would have in hand if it stopped the solver then: at most "
                  "this eta on half, or on nine in ten, of the problems. Lower and further "
                  "left is better; the end of a curve is what a solver comes to.",
              .mark = Mark::kLines};
    std::vector<double> etas;
    for (const Rank& line : n.ranking()) {
      const auto found = held.find(line.solver);
      plot.series.push_back({.name = line.solver, .style = plot.series.size()});
      if (found == held.end()) continue;
      plot.series.back().points = quantile_curve(found->second, times_s, p);
      for (const PlotPoint& point : plot.series.back().points) etas.push_back(point.y);
    }
    plot.x = log_axis("solver time [s]", Quantity::kTime, times_s);
    plot.x.high = times_s.back();
    plot.y = log_axis("verified eta [-]", Quantity::kEta, etas);
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace conebench::results
