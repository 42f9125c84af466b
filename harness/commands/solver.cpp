#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "harness/commands/commands.h"
#include "harness/parameter_text.h"
#include "harness/plugin.h"
#include "harness/skeleton.h"
#include "harness/solver_check.h"
#include "harness/solver_reference.h"
#include "harness/variants.h"
#include "problems/error.h"
#include "problems/suggest.h"
#include "results/text.h"
#include "solvers/registry.h"

namespace conebench::harness {
namespace {

using nlohmann::json;

json to_json(const solvers::Parameter& p) {
  json value = {{"name", p.name}, {"doc", p.doc}, {"choices", p.choices}};
  std::visit([&](const auto& v) { value["default"] = v; }, p.fallback);
  value["low"] = std::isfinite(p.low) ? json(p.low) : json(nullptr);
  value["high"] = std::isfinite(p.high) ? json(p.high) : json(nullptr);
  return value;
}

json to_json(const solvers::Method& method) {
  json parameters = json::array();
  for (const auto& p : method.parameters) parameters.push_back(to_json(p));
  return {{"name", method.name},
          {"kind", solvers::to_string(method.kind)},
          {"summary", method.summary},
          {"source", method.source},
          {"parameters", parameters}};
}

solvers::Method method_named(const std::string& name) {
  if (name.starts_with(kPluginPrefix)) return plugin_method({name, {}});
  std::vector<std::string> known;
  for (const auto& method : solvers::all_methods()) {
    if (method.name == name) return method;
    known.push_back(method.name);
  }
  throw problems::InputError(
      name, fmt::format("no such solver{}; known: {}", problems::suggestion(name, known),
                        fmt::join(known, ", ")));
}

void list(bool as_json) {
  if (as_json) {
    json all = json::array();
    for (const auto& method : solvers::all_methods()) all.push_back(to_json(method));
    fmt::print("{}\n", all.dump(2));
    return;
  }
  for (const auto& method : solvers::all_methods()) {
    fmt::print("{:<16} {:<7} {}\n", method.name, solvers::to_string(method.kind), method.summary);
  }
  fmt::print("{:<16} {:<7} {}\n", "exec:PROGRAM", "peer",
             "a program of yours: reads a problem file, writes r (docs/add-a-solver.md)");
  fmt::print("{:<16} {:<7} {}\n", "plugin:FILE", "peer",
             "a shared library of yours: harness/plugin_api.h (docs/add-a-solver.md)");
}

void show(const std::string& name, bool as_json) {
  const solvers::Method method = method_named(name);
  if (as_json) {
    fmt::print("{}\n", to_json(method).dump(2));
    return;
  }
  fmt::print("{} ({}): {}\n", method.name, solvers::to_string(method.kind), method.summary);
  if (!method.source.empty()) fmt::print("source: {}\n", method.source);
  for (const auto& p : method.parameters) {
    fmt::print("\n  {} = {}   ({})\n      {}\n", p.name, value_text(p.fallback), range_text(p),
               p.doc);
  }
}

int check(const std::string& variant, const std::vector<std::filesystem::path>& paths) {
  bool good = true;
  for (const CheckResult& result : check_solver(make_solver(variant), paths)) {
    const auto& r = result.record;
    fmt::print("{}  {}: {}, eta {}, {} iterations{}\n", result.passed ? "pass" : "FAIL",
               r.problem.name, results::to_string(r.status), results::format_eta(r.eta),
               r.iterations, r.error.empty() ? "" : ", " + r.error);
    for (const std::string& note : r.notes) {
      if (!result.passed) fmt::print("      {}\n", note);
    }
    good = good && result.passed;
  }
  return good ? 0 : 1;
}

void make_new(const std::string& name, const std::string& language,
              const std::filesystem::path& folder) {
  for (const auto& path : write_skeleton(name, language, folder)) {
    fmt::print("{}\n", path.string());
  }
}

}  // namespace

void add_solver(CLI::App& app, int& exit_code) {
  struct Options {
    std::string name;
    std::vector<std::filesystem::path> paths;
    std::string language = "c++";
    std::filesystem::path folder;
    bool json = false;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb =
      app.add_subcommand("solver", "List, show or check the solvers, or start a new one");
  verb->require_subcommand(1);

  CLI::App* list_verb = verb->add_subcommand("list", "All solvers, one a line");
  list_verb->add_flag("--json", options->json, "Print one JSON array");
  list_verb->callback([options] { list(options->json); });

  CLI::App* show_verb = verb->add_subcommand("show", "A solver's parameters");
  show_verb->add_option("NAME", options->name, "e.g. gs, or plugin:FILE")
      ->type_name("SOLVER")
      ->required();
  show_verb->add_flag("--json", options->json, "Print one JSON object");
  show_verb->callback([options] { show(options->name, options->json); });

  CLI::App* reference_verb =
      verb->add_subcommand("reference", "All of them in Markdown: what docs/solvers.md holds");
  reference_verb->callback([] { fmt::print("{}", solver_reference(solvers::all_methods())); });

  CLI::App* check_verb = verb->add_subcommand(
      "check", "Run a solver on small problems of every kind, with known solutions");
  check_verb->add_option("VARIANT", options->name, "e.g. gs[omega=0.8]")
      ->type_name("SOLVER")
      ->required();
  check_verb->add_option("PATH", options->paths, "Problem files or folders to use instead")
      ->type_name("");
  check_verb->callback([options, &exit_code] { exit_code = check(options->name, options->paths); });

  CLI::App* new_verb = verb->add_subcommand(
      "new", "Write a solver of your own that works, to start from; prints its files");
  new_verb->add_option("NAME", options->name, "Letters, digits, '_' and '-'")->required();
  new_verb->add_option("--language", options->language, "c, c++ or python")
      ->type_name("c|c++|python")
      ->capture_default_str();
  new_verb->add_option("-o,--output", options->folder, "Folder (default: NAME)")->type_name("DIR");
  new_verb->callback([options] {
    make_new(options->name, options->language,
             options->folder.empty() ? std::filesystem::path(options->name) : options->folder);
  });
}

}  // namespace conebench::harness
