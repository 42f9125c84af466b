#include "dem/scene.h"

#include <fmt/format.h>

#include "problems/error.h"

namespace conebench::dem {

int material_index(const Scene& scene, std::string_view name) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    if (scene.materials[i].name == name) return static_cast<int>(i);
  }
  throw problems::InputError(scene.name, fmt::format("no material \"{}\"", name));
}

int motion_index(const Scene& scene, std::string_view name) {
  for (std::size_t i = 0; i < scene.motions.size(); ++i) {
    if (scene.motions[i].name == name) return static_cast<int>(i);
  }
  throw problems::InputError(scene.name, fmt::format("no motion \"{}\"", name));
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
  const engine::SceneText scene = engine::load_scene_text(name_or_path, builtin_scenes());
  return parse_scene(scene.text, scene.subject);
}

}  // namespace conebench::dem
