// Findings as JSON, CSV and plots.

#include <fmt/format.h>

#include <cmath>

#include "harness/trajectory_report.h"

namespace conebench::harness {
namespace {

using Json = nlohmann::ordered_json;
using results::Axis;
using results::Plot;
using results::Quantity;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json to_json(const Sample& sample) {
  return {
      {"count", sample.count}, {"mean", number(sample.mean)}, {"spread", number(sample.spread)}};
}

Json to_json(const FindingsLine& line) {
  Json out = {{"solver", line.solver}, {"tol", line.tol}, {"failed", line.failed}};
  for (const ObservableKind& kind : observables()) {
    const Finding& finding = line[kind.what];
    Json& entry = out["observed"][std::string(kind.key)];
    entry = to_json(finding.value);
    entry["deviation"] = to_json(finding.deviation);
    entry["within"] = finding.within ? Json(*finding.within) : Json();
  }
  return out;
}

std::string field(double value) { return std::isfinite(value) ? fmt::format("{}", value) : ""; }

// Variants hold commas.
std::string csv_line(const ObservableKind& kind, const FindingsLine& line, bool reference,
                     double yardstick) {
  const Finding& finding = line[kind.what];
  return fmt::format("{},{},\"{}\",{},{},{},{},{},{},{},{},{}\n", kind.key, kind.unit, line.solver,
                     line.tol, reference ? 1 : 0, finding.value.count, field(finding.value.mean),
                     field(finding.value.spread), field(finding.deviation.mean),
                     field(finding.deviation.spread), field(yardstick),
                     finding.within ? (*finding.within ? "1" : "0") : "");
}

// Where means and spreads of all lines lie.
std::vector<double> ends_of(const Findings& findings, const ObservableKind& kind) {
  std::vector<double> ends;
  const auto add = [&](const Sample& s) {
    const double spread = std::isfinite(s.spread) ? s.spread : 0.0;
    ends.insert(ends.end(), {s.mean - spread, s.mean + spread});
  };
  for (const FindingsLine& line : findings.lines) add(line[kind.what].value);
  add(findings.reference[kind.what].value);
  return ends;
}

// Curves of one plot are set apart a little, so that their spreads do not cover each other.
results::Series curve_of(const Findings& findings, const ObservableKind& kind, std::size_t index) {
  constexpr double kApart = 1.15;
  results::Series series{.name = findings.solvers[index], .style = index};
  const double middle = 0.5 * static_cast<double>(findings.solvers.size() - 1);
  for (const FindingsLine& line : findings.lines) {
    const Sample& s = line[kind.what].value;
    if (line.solver != series.name || s.count == 0) continue;
    const double x = line.tol * std::pow(kApart, middle - static_cast<double>(index));
    series.points.push_back({.x = x, .y = s.mean});
    if (!std::isfinite(s.spread)) continue;
    series.points.back().y_interval = results::Interval{s.mean - s.spread, s.mean + s.spread};
  }
  return series;
}

// With room beside the first and the last, loosest first.
Axis tolerance_axis(const std::vector<double>& tolerances) {
  constexpr double kRoom = 2.0;
  return {.label = "tolerance on eta",
          .quantity = Quantity::kEta,
          .scale = results::Scale::kLog10,
          .low = tolerances.back() / kRoom,
          .high = tolerances.front() * kRoom,
          .falling = true};
}

Axis y_axis(const Findings& findings, const ObservableKind& kind) {
  const std::string label = kind.unit == "-" ? std::string(kind.words) + " [-]"
                                             : fmt::format("{} [{}]", kind.words, kind.unit);
  const std::vector<double> ends = ends_of(findings, kind);
  if (kind.what == Observable::kStepTime) return log_axis(label, Quantity::kTime, ends);
  if (kind.what != Observable::kUnconverged) {
    return linear_axis(label, Quantity::kRatio, ends);
  }
  return {.label = std::string(kind.words), .quantity = Quantity::kShare, .low = 0.0, .high = 1.0};
}

}  // namespace

Json to_json(const Findings& findings) {
  Json out = {{"scene", findings.scene},
              {"engine", findings.engine},
              {"seeds", findings.seeds},
              {"seed_matters", findings.seed_matters},
              {"reference", to_json(findings.reference)},
              {"enough", Json::array()},
              {"lines", Json::array()}};
  for (const ObservableKind& kind : observables()) {
    if (!kind.physical) continue;
    for (const std::string& solver : findings.solvers) {
      const auto tol = findings.enough(solver, kind.what);
      out["enough"].push_back({{"observable", kind.key},
                               {"solver", solver},
                               {"yardstick", number(findings.yardstick(kind.what))},
                               {"tol", tol ? Json(*tol) : Json()}});
    }
  }
  for (const FindingsLine& line : findings.lines) out["lines"].push_back(to_json(line));
  return out;
}

std::string trajectory_csv(const Findings& findings) {
  std::string csv =
      "observable,unit,solver,tol,reference,seeds,mean,spread,deviation,deviation_spread,"
      "yardstick,within\n";
  for (const ObservableKind& kind : observables()) {
    const double yardstick = findings.yardstick(kind.what);
    csv += csv_line(kind, findings.reference, true, yardstick);
    for (const FindingsLine& line : findings.lines) csv += csv_line(kind, line, false, yardstick);
  }
  return csv;
}

std::vector<Plot> trajectory_plots(const Findings& findings) {
  std::vector<Plot> plots;
  for (const ObservableKind& kind : observables()) {
    const Sample& reference = findings.reference[kind.what].value;
    if (reference.count == 0) continue;
    Plot plot{.id = std::string(kind.key),
              .title = fmt::format("{}: {}", findings.scene, kind.words),
              .mark = results::Mark::kLines,
              .x = tolerance_axis(findings.tolerances),
              .y = y_axis(findings, kind)};
    const double spread = std::isfinite(reference.spread) ? reference.spread : 0.0;
    plot.band = {.range = {reference.mean - spread, reference.mean + spread},
                 .name = fmt::format("reference, {} to {:g}", findings.reference.solver,
                                     findings.reference.tol)};
    for (std::size_t k = 0; k < findings.solvers.size(); ++k) {
      plot.series.push_back(curve_of(findings, kind, k));
    }
    plots.push_back(std::move(plot));
  }
  return plots;
}

}  // namespace conebench::harness
