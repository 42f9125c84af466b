#include "harness/trajectory_report.h"

#include <fmt/format.h>

#include <cmath>

#include "results/text.h"

namespace conebench::harness {
namespace {

using Json = nlohmann::ordered_json;
using results::TextTable;

std::string number(double value, int digits = 4) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : "-";
}

std::string with_unit(const ObservableKind& kind) {
  return kind.unit == "-" ? std::string(kind.words) : fmt::format("{} [{}]", kind.words, kind.unit);
}

std::string plus_minus(const Sample& sample, int digits = 4) {
  if (sample.count == 0) return "-";
  if (!std::isfinite(sample.spread)) return number(sample.mean, digits);
  return fmt::format("{} +- {}", number(sample.mean, digits), number(sample.spread, 2));
}

std::string tolerance(double tol) { return fmt::format("{:g}", tol); }

std::string enough_table(const Findings& findings) {
  std::vector<std::string> header = {"enough for", "yardstick"};
  for (const std::string& solver : findings.solvers) header.push_back(results::tick(solver));
  TextTable table(header);
  for (const ObservableKind& kind : observables()) {
    if (!kind.physical || findings.reference[kind.what].value.count == 0) continue;
    std::vector<std::string> row = {with_unit(kind), number(findings.yardstick(kind.what), 2)};
    for (const std::string& solver : findings.solvers) {
      const auto tol = findings.enough(solver, kind.what);
      row.push_back(tol ? tolerance(*tol) : "none tried");
    }
    table.add(std::move(row));
  }
  return table.text();
}

void add_cost(const FindingsLine& line, const std::string& name, TextTable& table) {
  table.add({name, tolerance(line.tol), plus_minus(line[Observable::kIterations].value, 3),
             results::format_time(line[Observable::kStepTime].value.mean),
             fmt::format("{:.3g} %", 100.0 * line[Observable::kUnconverged].value.mean),
             std::to_string(line.failed)});
}

std::string cost_table(const Findings& findings) {
  TextTable table({"solver", "tol", "iterations a step", "solver time a step",
                   "steps not converged", "runs failed"});
  for (const FindingsLine& line : findings.lines) {
    add_cost(line, results::tick(line.solver), table);
  }
  add_cost(findings.reference, "reference: " + results::tick(findings.reference.solver), table);
  return table.text();
}

std::string values_table(const Findings& findings, const ObservableKind& kind) {
  TextTable table({with_unit(kind), "tol", "mean +- spread", "deviation +- spread", "within"});
  for (const FindingsLine& line : findings.lines) {
    const Finding& finding = line[kind.what];
    table.add({results::tick(line.solver), tolerance(line.tol), plus_minus(finding.value),
               plus_minus(finding.deviation, 2),
               !finding.within ? "-" : (*finding.within ? "yes" : "no")});
  }
  table.add({"reference: " + results::tick(findings.reference.solver),
             tolerance(findings.reference.tol), plus_minus(findings.reference[kind.what].value), "",
             ""});
  return table.text();
}

std::string notes(const Findings& findings) {
  std::string text;
  if (!findings.seed_matters) {
    text +=
        "\nThe seed changes nothing in this scene, so that there is no spread to hold deviations "
        "against" +
        std::string(findings.engine == "mpm"
                        ? "; --set 'blocks[0].jitter=0.5' disturbs the particles by their seed"
                        : "") +
        ".\n";
  } else if (findings.seeds.size() < 2) {
    text += "\nOne seed has no spread to hold deviations against.\n";
  }
  const double loose = findings.reference[Observable::kUnconverged].value.mean;
  if (loose > 0.0) {
    text += fmt::format("\nThe reference missed its own tolerance in {:.3g} % of its steps.\n",
                        100.0 * loose);
  }
  if (findings.reference.failed > 0) text += "\nThe reference failed for some seed.\n";
  return text;
}

}  // namespace

std::string trajectory_text(const Findings& findings) {
  std::string text =
      fmt::format("{} ({}), {} seed{}, reference {} to eta <= {:g}\n", findings.scene,
                  findings.engine, findings.seeds.size(), findings.seeds.size() == 1 ? "" : "s",
                  results::tick(findings.reference.solver), findings.reference.tol);
  text += notes(findings);
  text +=
      "\nThe loosest tolerance that is enough: from it on down the mean deviation from the "
      "reference\nlies within the reference's spread over seeds (the yardstick).\n\n";
  text += enough_table(findings) + "\n" + cost_table(findings);
  for (const ObservableKind& kind : observables()) {
    if (!kind.physical || findings.reference[kind.what].value.count == 0) continue;
    text += "\n" + values_table(findings, kind);
  }
  return text;
}

std::string trajectory_markdown(const Findings& findings, const std::string& command) {
  std::string text =
      fmt::format("# What tolerance is enough: {}\n\n`{}`\n\n", findings.scene, command);
  text += trajectory_text(findings);
  for (const results::Plot& plot : trajectory_plots(findings)) {
    text += fmt::format("\n![{}]({}.svg)\n", plot.title, plot.id);
  }
  return text +
         "\nSpread: the standard deviation over seeds. A deviation is that of runs of one seed, "
         "which start alike;\nruns of a collapse part soon, as any two solutions of it do, so that "
         "single deviations are of the size of\nthe spread and only their mean is held against it. "
         "Energy drift: the work of reactions beyond what\ntheir law gives them, of all steps; its "
         "yardstick is the spread of the energy change. Front: the\nhorizontal distance from "
         "where the centre of mass began within which 99 % of the mass lies.\n";
}

}  // namespace conebench::harness
