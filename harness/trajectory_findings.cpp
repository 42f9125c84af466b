#include "harness/trajectory_findings.h"

#include <cmath>
#include <limits>
#include <map>

namespace conebench::harness {
namespace {

using Runs = std::vector<const TrajectoryRow*>;

double value_of(const TrajectoryRow& row, const ObservableKind& kind) {
  return row.observed[static_cast<std::size_t>(kind.what)];
}

// `reference` has the runs of the same seeds, in the same order.
FindingsLine line_of(const Runs& runs, const Runs& reference) {
  FindingsLine line{.solver = runs.front()->solver, .tol = runs.front()->tol, .of = {}};
  for (const TrajectoryRow* run : runs) line.failed += run->error.empty() ? 0 : 1;
  for (const ObservableKind& kind : observables()) {
    std::vector<double> values, deviations;
    for (std::size_t k = 0; k < runs.size(); ++k) {
      values.push_back(value_of(*runs[k], kind));
      deviations.push_back(values.back() - value_of(*reference[k], kind));
    }
    line.of[static_cast<std::size_t>(kind.what)] = {
        .value = sample_of(values), .deviation = sample_of(deviations), .within = {}};
  }
  return line;
}

void judge(const Findings& findings, FindingsLine& line) {
  for (const ObservableKind& kind : observables()) {
    Finding& finding = line.of[static_cast<std::size_t>(kind.what)];
    const double yardstick = findings.yardstick(kind.what);
    const bool whole = finding.deviation.count == findings.seeds.size();
    if (!kind.physical || line.failed > 0 || !whole || !std::isfinite(yardstick)) continue;
    finding.within = std::abs(finding.deviation.mean) <= yardstick;
  }
}

}  // namespace

Sample sample_of(const std::vector<double>& values) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  Sample sample{.count = 0, .mean = 0.0, .spread = 0.0};
  for (const double value : values) {
    if (std::isnan(value)) continue;
    ++sample.count;
    sample.mean += value;
  }
  if (sample.count == 0) return {.count = 0, .mean = kNone, .spread = kNone};
  sample.mean /= static_cast<double>(sample.count);
  for (const double value : values) {
    if (!std::isnan(value)) sample.spread += (value - sample.mean) * (value - sample.mean);
  }
  sample.spread =
      sample.count < 2 ? kNone : std::sqrt(sample.spread / static_cast<double>(sample.count - 1));
  return sample;
}

double Findings::yardstick(Observable what) const {
  return reference[observables()[static_cast<std::size_t>(what)].yardstick].value.spread;
}

std::optional<double> Findings::enough(const std::string& solver, Observable what) const {
  std::optional<double> loosest;
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    if (line->solver != solver) continue;
    if (!(*line)[what].within.value_or(false)) break;
    loosest = line->tol;
  }
  return loosest;
}

Findings find(const TrajectoryPlan& plan, const std::vector<TrajectoryRow>& rows) {
  Runs reference;
  std::map<std::pair<std::string, double>, Runs> members;
  for (const TrajectoryRow& row : rows) {
    (row.reference ? reference : members[{row.solver, row.tol}]).push_back(&row);
  }
  Findings findings{.scene = plan.scene,
                    .engine = plan.engine,
                    .solvers = plan.solvers,
                    .tolerances = plan.tolerances,
                    .seeds = plan.seeds,
                    .seed_matters = plan.seed_matters,
                    .reference = line_of(reference, reference),
                    .lines = {}};
  for (const std::string& solver : plan.solvers) {
    for (const double tol : plan.tolerances) {
      findings.lines.push_back(line_of(members.at({solver, tol}), reference));
      judge(findings, findings.lines.back());
    }
  }
  return findings;
}

}  // namespace conebench::harness
