#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "harness/commands/commands.h"
#include "harness/engine.h"

namespace conebench::harness {
namespace {

void list(bool json) {
  auto entries = nlohmann::json::array();
  for (const EngineKind& kind : all_engines()) {
    for (const auto& [name, text] : kind.builtin) {
      const engine::SceneHeader scene = kind.read({std::string(name), std::string(text)});
      entries.push_back({{"name", name},
                         {"engine", kind.name},
                         {"steps", scene.step_count()},
                         {"step_s", scene.step_s},
                         {"solver", scene.solver.name},
                         {"tol", scene.solver.tol}});
    }
  }
  if (json) {
    fmt::print("{}\n", entries.dump());
    return;
  }
  fmt::print("{:<22} {:<6} {:>6} {:>8}  {}\n", "scene", "engine", "steps", "step", "solver");
  for (const auto& entry : entries) {
    fmt::print("{:<22} {:<6} {:>6} {:>6g} s  {} to {:g}\n", entry["name"].get<std::string>(),
               entry["engine"].get<std::string>(), entry["steps"].get<std::int64_t>(),
               entry["step_s"].get<double>(), entry["solver"].get<std::string>(),
               entry["tol"].get<double>());
  }
}

}  // namespace

void add_scene(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("scene", "The scenes that the engines run");
  verb->require_subcommand(1);

  auto json = std::make_shared<bool>(false);
  CLI::App* list_verb = verb->add_subcommand("list", "List the built-in scenes");
  list_verb->add_flag("--json", *json, "Print one JSON array");
  list_verb->callback([json, &exit_code] {
    list(*json);
    exit_code = 0;
  });

  auto name = std::make_shared<std::string>();
  CLI::App* show = verb->add_subcommand("show", "Print a scene with every default, as TOML");
  show->add_option("SCENE", *name, "Built-in name or .toml file")->type_name("")->required();
  show->callback([name, &exit_code] {
    const engine::SceneText scene = find_scene(*name);
    fmt::print("{}", engine_of(scene).print(scene));
    exit_code = 0;
  });
}

}  // namespace conebench::harness
