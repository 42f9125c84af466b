// What the seed of a scene changes: the random parts of its start, and nothing else.

#include <gtest/gtest.h>

#include "dem/placement.h"
#include "harness/engine.h"
#include "mpm/placement.h"
#include "mpm/scene.h"

namespace conebench::harness {
namespace {

engine::SceneText with(const engine::BuiltinScene& scene,
                       const std::vector<std::string>& overrides) {
  return engine::with_overrides({std::string(scene.name), std::string(scene.text)}, overrides);
}

bool names_a_seed(const engine::BuiltinScene& scene) {
  return scene.text.find("\nseed = ") != scene.text.npos;
}

std::vector<Eigen::Vector3d> places(const engine::BuiltinScene& scene, const std::string& seed) {
  const engine::SceneText text = with(scene, {"seed=" + seed});
  return dem::place_bodies(dem::parse_scene(text.text, text.subject), text.subject).bodies.position;
}

TEST(Seed, MovesTheBodiesOfEverySceneThatNamesOneAndOfNoOther) {
  for (const engine::BuiltinScene& scene : dem::builtin_scenes()) {
    const bool same = places(scene, "1") == places(scene, "2");
    EXPECT_EQ(same, !names_a_seed(scene)) << scene.name;
    EXPECT_EQ(places(scene, "2"), places(scene, "2")) << scene.name;
  }
}

std::vector<Eigen::Vector3d> grains(const engine::BuiltinScene& scene, const std::string& seed,
                                    const std::string& jitter) {
  const engine::SceneText text = with(scene, {"seed=" + seed, "blocks[0].jitter=" + jitter});
  return mpm::place_particles(mpm::parse_scene(text.text, text.subject), {}).position;
}

TEST(Seed, MovesSandWhereItIsJittered) {
  for (const engine::BuiltinScene& scene : mpm::builtin_scenes()) {
    EXPECT_NE(grains(scene, "1", "0.5"), grains(scene, "2", "0.5")) << scene.name;
    EXPECT_EQ(grains(scene, "2", "0.5"), grains(scene, "2", "0.5")) << scene.name;
    EXPECT_EQ(grains(scene, "1", "0"), grains(scene, "2", "0")) << scene.name;
  }
}

}  // namespace
}  // namespace conebench::harness
