#include "dem/scene.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "dem/builtin_scenes.h"
#include "problems/error.h"
#include "problems/suggest.h"

namespace conebench::dem {
namespace {

using problems::InputError;

Scene load_file(const std::string& path) {
  std::ifstream file(path);
  problems::require(file && !std::filesystem::is_directory(path), path,
                    "cannot be read, expected a scene file");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  return parse_scene(text, path);
}

}  // namespace

std::int64_t Scene::step_count() const {
  // A duration of 0.3 s holds 300 steps of 1e-3 s, not 301, whatever 0.3 / 1e-3 rounds to.
  return static_cast<std::int64_t>(std::ceil(duration_s / step_s * (1.0 - 1e-12)));
}

int material_index(const Scene& scene, std::string_view name) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (scene.materials[i].name == name) return static_cast<int>(i);
  }
  throw InputError(scene.name, fmt::format("no material \"{}\"", name));
}

std::optional<PairLaw> law_between(const Scene& scene, std::string_view first,
                                   std::string_view second) {
  for (const Pair& pair : scene.pairs) {
    if (pair.first == first && pair.second == second) return pair.law;
    if (pair.first == second && pair.second == first) return pair.law;
  }
  return scene.default_pair;
}

Scene load_scene(const std::string& name_or_path) {
  for (const BuiltinScene& scene : builtin_scenes()) {
    if (scene.name == name_or_path) return parse_scene(scene.text, name_or_path);
  }
  const bool is_path = name_or_path.find('/') != std::string::npos ||
                       name_or_path.ends_with(".toml") || std::filesystem::exists(name_or_path);
  if (is_path) return load_file(name_or_path);
  const auto names = builtin_scene_names();
  throw InputError(name_or_path,
                   fmt::format("no such scene{}; known: {}",
                               problems::suggestion(name_or_path, names), fmt::join(names, ", ")));
}

std::vector<std::string> builtin_scene_names() {
  std::vector<std::string> names;
  for (const BuiltinScene& scene : builtin_scenes()) names.emplace_back(scene.name);
  return names;
}

}  // namespace conebench::dem
