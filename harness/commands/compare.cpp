#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "harness/command_line.h"
#include "harness/commands/commands.h"
#include "harness/commands/text_output.h"
#include "harness/condition.h"
#include "harness/summary.h"
#include "results/compare.h"
#include "results/text.h"

namespace conebench::harness {
namespace {

using results::Comparison;
using results::Quantity;

constexpr int kGateFailed = 1;
constexpr std::size_t kMostNames = 20;

struct CompareOptions {
  std::filesystem::path base, fresh;
  std::string gate;
  bool json = false;
};

Json json_of(double value) {
  return std::isfinite(value) ? Json(value) : Json(value > 0 ? "infinite" : "-infinite");
}

Json json_of(const std::optional<double>& value) { return value ? json_of(*value) : Json(nullptr); }

Json json_of(const std::optional<results::Interval>& interval) {
  if (!interval) return nullptr;
  return Json::array({json_of(interval->low), json_of(interval->high)});
}

Json json_of(const Comparison& c) {
  Json quantities = Json::object();
  for (const Quantity& q : c.quantities) {
    quantities[q.name] = {{"base", json_of(q.base)},
                          {"new", json_of(q.fresh)},
                          {"value", json_of(q.value)},
                          {"interval", json_of(q.interval)}};
  }
  return {{"pairs", c.pairs},
          {"scenes", c.scenes},
          {"only_base", c.only_base},
          {"only_new", c.only_fresh},
          {"superseded", c.superseded},
          {"other_host", c.other_host},
          {"new_failures", c.new_failures},
          {"new_successes", c.new_successes},
          {"quantities", quantities},
          {"noise", json_of(c.noise)},
          {"no_difference_measurable", c.no_difference_measurable()}};
}

std::string side_text(const std::string& name, const std::optional<double>& value) {
  if (!value) return "-";
  if (!std::isfinite(*value)) return "unsolved";
  if (name.ends_with("(time)")) return results::format_time(*value);
  if (name == "gm(eta)") return results::format_eta(*value);
  return fmt::format("{:.4g}", *value);
}

std::string number_text(const std::optional<double>& value) {
  return value ? fmt::format("{:.4g}", *value) : "-";
}

std::string interval_text(const std::optional<results::Interval>& interval) {
  return interval ? fmt::format("{:.4g} to {:.4g}", interval->low, interval->high) : "-";
}

void print_names(const char* what, const std::vector<std::string>& names) {
  if (names.empty()) return;
  fmt::print("\n{}: {}\n", what, names.size());
  for (std::size_t i = 0; i < std::min(names.size(), kMostNames); ++i) {
    fmt::print("  {}\n", names[i]);
  }
  if (names.size() > kMostNames) {
    fmt::print("  and {} more; --json names all\n", names.size() - kMostNames);
  }
}

std::string noise_text(const Comparison& c) {
  if (!c.noise) return "noise of the times not known: no task was repeated";
  const std::string floor =
      fmt::format("two identical programs show ratios of sgm(time) up to {:.3f}", *c.noise);
  return c.no_difference_measurable() ? "no difference measurable in sgm(time): " + floor : floor;
}

void print_comparison(const Comparison& c) {
  results::TextTable table({"quantity", "BASE", "NEW", "NEW/BASE", "95 %"});
  for (const Quantity& q : c.quantities) {
    table.add({q.name, side_text(q.name, q.base), side_text(q.name, q.fresh), number_text(q.value),
               interval_text(q.interval)});
  }
  fmt::print("{} pairs of rows, {} scenes\n\n{}\n{}\n", c.pairs, c.scenes, table.text(),
             noise_text(c));
  if (c.scenes < results::kFewestScenes) fmt::print("too few scenes for intervals\n");
  if (c.other_host) fmt::print("the two sides ran on different machines: times do not compare\n");
  if (c.superseded > 0) fmt::print("{} rows left out: a later one replaces each\n", c.superseded);
  print_names("solved in BASE, not in NEW", c.new_failures);
  print_names("solved in NEW, not in BASE", c.new_successes);
  print_names("rows without a partner in NEW", c.only_base);
  print_names("rows without a partner in BASE", c.only_fresh);
}

// JSON has no infinity, but a value in memory may be one.
bool passes(const Condition& gate, const Comparison& comparison) {
  Json facts = Json::object();
  for (const auto& [name, value] : comparison.gate_values()) {
    facts[name] = value ? Json(*value) : Json(nullptr);
  }
  return gate.matches(facts);
}

int compare(const CompareOptions& options) {
  const Condition gate(
      options.gate.empty() ? "true" : options.gate,
      {.option = "--gate", .noun = "quantity", .names = results::quantity_names()});
  const auto base = load_records(options.base), fresh = load_records(options.fresh);
  const Comparison comparison = results::compare(base, fresh);
  const bool passed = passes(gate, comparison);
  if (options.json) {
    Json json = json_of(comparison);
    json["gate"] = options.gate.empty() ? Json(nullptr)
                                        : Json{{"expression", options.gate}, {"passed", passed}};
    print_json(json);
  } else {
    print_comparison(comparison);
    if (!options.gate.empty()) {
      fmt::print("\ngate {}: {}\n", passed ? "passed" : "FAILED", options.gate);
    }
  }
  return passed ? 0 : kGateFailed;
}

}  // namespace

void add_compare(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<CompareOptions>();
  CLI::App* verb = app.add_subcommand(
      "compare", "Compare two sets of results task by task; with --gate, exit 1 when it fails");
  verb->add_option("BASE", options->base, "Results folder to compare with")
      ->type_name("DIR")
      ->required();
  verb->add_option("NEW", options->fresh, "Results folder to judge")->type_name("DIR")->required();
  verb->add_option("--gate", options->gate,
                   "e.g. 'sgm(time) < 1.05 && failures <= 0'. Ratios NEW/BASE: sgm(time), "
                   "p50(time), p99(time), max(time), gm(eta), iterations, worst(iterations) "
                   "(of one pair), solved; counts: failures "
                   "(solved in BASE, not in NEW), missing (rows of BASE that NEW lacks). A ratio "
                   "that is undefined passes no comparison; sgm(time) is 1 inside the noise floor")
      ->type_name("CONDITION");
  verb->add_flag("--json", options->json, "One JSON object instead of a table");
  verb->callback([options, &exit_code] { exit_code = compare(*options); });
}

}  // namespace conebench::harness
