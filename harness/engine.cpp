#include "harness/engine.h"

#include <fmt/format.h>

#include <array>

#include "problems/error.h"

namespace conebench::harness {
std::span<const EngineKind> all_engines() {
  static const std::array<EngineKind, 2> kEngines = {dem_engine(), mpm_engine()};
  return kEngines;
}

const EngineKind& engine_of(const engine::SceneText& scene) {
  const std::string name = engine::read_engine(scene);
  for (const EngineKind& kind : all_engines()) {
    if (kind.name == name) return kind;
  }
  throw problems::InputError(scene.subject, "no such engine: " + name);
}

engine::SceneText find_scene(const std::string& name_or_path) {
  std::vector<engine::BuiltinScene> builtin;
  for (const EngineKind& kind : all_engines()) {
    builtin.insert(builtin.end(), kind.builtin.begin(), kind.builtin.end());
  }
  return engine::load_scene_text(name_or_path, builtin);
}

std::unique_ptr<Engine> make_engine(const engine::SceneText& scene, const EngineOptions& options) {
  return engine_of(scene).make(scene, options);
}

engine::SolverChoice solver_choice(const engine::SceneHeader& scene, const EngineOptions& options) {
  engine::SolverChoice choice = scene.solver;
  if (!options.solver.empty()) choice.name = options.solver;
  return choice;
}

std::string frame_name(std::size_t index) { return fmt::format("frame_{:03}.svg", index); }

}  // namespace conebench::harness
