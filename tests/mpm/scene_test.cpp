#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "problems/error.h"
#include "tests/mpm/scene_texts.h"

namespace conebench::test {
namespace {

using mpm::Condition;
using testing::AllOf;
using testing::HasSubstr;

std::string print(const std::string& text) { return mpm::to_toml(mpm::parse_scene(text, "heap")); }

TEST(MpmScene, ReadsWhatIsWrittenAndFillsInDefaults) {
  const mpm::Scene scene = mpm::parse_scene(kScene, "heap.toml");
  EXPECT_EQ(scene.grid.dim, 2);
  EXPECT_EQ(scene.grid.cells, Eigen::Vector3i(40, 20, 0));
  EXPECT_EQ(scene.grid.size_m, Eigen::Vector3d(2.0, 1.0, 0.0));
  EXPECT_EQ(scene.gravity_m_s2, Eigen::Vector3d(0.0, -9.81, 0.0));
  EXPECT_EQ(scene.grid.refine, mpm::Refine::kNone);
  EXPECT_EQ(scene.cfl, 0.5);
  EXPECT_EQ(scene.material.law, mpm::Law::kMonotone);
  EXPECT_EQ(scene.material.phi_max, 1.0);
  for (const mpm::Wall& wall : scene.walls) EXPECT_EQ(wall.condition, Condition::kSlip);
  ASSERT_EQ(scene.blocks.size(), 1u);
  EXPECT_EQ(scene.blocks[0].fraction, 1.0);
  EXPECT_EQ(scene.blocks[0].high_m, Eigen::Vector3d(0.5, 0.5, 0.0));
}

TEST(MpmScene, PrintedSceneReadsBackTheSame) {
  EXPECT_EQ(print(kFull), kFull);
  EXPECT_EQ(print(print(kScene)), print(kScene));
  for (const engine::BuiltinScene& scene : mpm::builtin_scenes()) {
    const std::string text = print(std::string(scene.text));
    EXPECT_EQ(print(text), text) << scene.name;
  }
}

TEST(MpmScene, OddNumbersReadBackTheSame) {
  const std::string text =
      print(kScene + "velocity_m_s = [-0.0, 1e-17, 0]\njitter = 0.3333333333333333\n" +
            "[[bodies]]\nshape = \"half-space\"\nnormal = [3, 5]\nmotion = \"static\"\n"
            "centre_m = [0, 0.1]\n");
  EXPECT_EQ(print(text), text);
  EXPECT_THAT(text,
              AllOf(HasSubstr("velocity_m_s = [0, 1e-17, 0]"), HasSubstr("0.3333333333333333")));
}

TEST(MpmScene, BuiltinsCarryTheirOwnNames) {
  for (const engine::BuiltinScene& scene : mpm::builtin_scenes()) {
    EXPECT_EQ(mpm::load_scene(std::string(scene.name)).name, scene.name);
  }
  EXPECT_THROW(mpm::load_scene("no/such/file.toml"), problems::InputError);
}

TEST(MpmScene, WallsAreWhereTheirNamesSay) {
  const std::string walls =
      "[walls]\nbottom = { condition = \"frictional\", friction = 0.3 }\nright = \"free\"\n";
  const mpm::Scene flat = mpm::parse_scene(kScene + walls, "flat");
  EXPECT_EQ(flat.wall(0, true).condition, Condition::kFree);
  EXPECT_EQ(flat.wall(1, false).condition, Condition::kFrictional);
  EXPECT_EQ(flat.wall(1, false).friction, 0.3);
  const mpm::Scene deep =
      mpm::parse_scene(changed(kFull, "back = \"slip\"", "back = \"stick\""), "");
  EXPECT_EQ(deep.wall(0, false).condition, Condition::kStick);
  EXPECT_EQ(deep.wall(1, false).condition, Condition::kSlip);
  EXPECT_EQ(deep.wall(1, true).condition, Condition::kStick);
  EXPECT_EQ(deep.wall(2, false).friction, 0.3);
  EXPECT_EQ(deep.wall(2, true).condition, Condition::kFree);
}

TEST(MpmScene, PlacesThatDifferByRoundingAreTheSame) {
  const std::string grid =
      changed(kScene, "size_m = [2, 1]", "size_m = [2, 0.1]\nlow_m = [0, 0.7]");
  const std::string block =
      changed(grid, "low_m = [0, 0]\nhigh_m = [0.5, 0.5]", "low_m = [0, 0.7]\nhigh_m = [0.5, 0.8]");
  EXPECT_LT(0.7 + 0.1, 0.8);
  EXPECT_EQ(error_of(block), "no error");
  const std::string beside = "[[blocks]]\nlow_m = [0.4999999999, 0]\nhigh_m = [1, 0.5]\n";
  EXPECT_EQ(error_of(kScene + beside), "no error");
}

}  // namespace
}  // namespace conebench::test
