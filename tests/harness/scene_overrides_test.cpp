// Values of a scene that the command line replaces.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mpm/scene.h"
#include "problems/engine/scene_file.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

using testing::HasSubstr;

const engine::SceneText kScene{"heap", R"(name = "heap"
gravity_m_s2 = [0, 0, -9.81]
[material]
friction = 0.4
[[blocks]]
high_m = [0.5, 0.25]
[[blocks]]
high_m = [1, 2]
)"};

toml::table with(const std::vector<std::string>& overrides) {
  return engine::parse_toml(engine::with_overrides(kScene, overrides));
}

TEST(SceneOverrides, NoneLeaveTheTextAlone) {
  const engine::SceneText same = engine::with_overrides(kScene, {});
  EXPECT_EQ(same.text, kScene.text);
  EXPECT_EQ(same.subject, kScene.subject);
}

TEST(SceneOverrides, ReplaceValuesAndKeepTheOthersToTheLastDigit) {
  const toml::table scene = with({"material.friction=0.1"});
  EXPECT_EQ(scene.at_path("material.friction").value<double>(), 0.1);
  EXPECT_EQ(scene.at_path("gravity_m_s2[2]").value<double>(), -9.81);
  EXPECT_EQ(scene.at_path("blocks[1].high_m[0]").value<std::int64_t>(), 1);
}

TEST(SceneOverrides, ReachIntoArraysAndAddKeys) {
  const toml::table scene =
      with({"blocks[1].high_m=[3, 4]", "blocks[0].high_m[1]=7", "material.cohesion_Pa=1e3"});
  EXPECT_EQ(scene.at_path("blocks[1].high_m[1]").value<std::int64_t>(), 4);
  EXPECT_EQ(scene.at_path("blocks[0].high_m[0]").value<double>(), 0.5);
  EXPECT_EQ(scene.at_path("blocks[0].high_m[1]").value<std::int64_t>(), 7);
  EXPECT_EQ(scene.at_path("material.cohesion_Pa").value<double>(), 1000.0);
}

TEST(SceneOverrides, TakeBareWordsAsStrings) {
  const toml::table scene =
      with({"material.law=dense-only", "name=\"quoted\"", "material.solver=gs[omega=1.3]"});
  EXPECT_EQ(scene.at_path("material.law").value<std::string>(), "dense-only");
  EXPECT_EQ(scene.at_path("name").value<std::string>(), "quoted");
  EXPECT_EQ(scene.at_path("material.solver").value<std::string>(), "gs[omega=1.3]");
}

// A table of defaults need not be there; one that nobody knows is named when the scene is read.
TEST(SceneOverrides, MakeMissingTables) {
  const std::vector<std::string> known = {"solver.tol=0.5"}, unknown = {"materiel.friction=1"};
  const engine::SceneText column = engine::load_scene_text("sand-bed", mpm::builtin_scenes());
  EXPECT_EQ(mpm::parse_scene(engine::with_overrides(column, known).text, "bed").solver.tol, 0.5);
  try {
    mpm::parse_scene(engine::with_overrides(column, unknown).text, "bed");
    ADD_FAILURE() << "materiel was taken";
  } catch (const problems::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean 'material'?"));
  }
}

TEST(SceneOverrides, SayWhatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> wrong = {
      {"blocks[2].high_m=[1, 1]", "no place [2], the array has 2"},
      {"gravity_m_s2[3]=1", "no place [3], the array has 3"},
      {"gravity_m_s2[x]=1", "found [x], expected a place"},
      {"gravity_m_s2.x=1", "the scene has no \"x\" there"},
      {"name[0]=1", "no place [0], the array has 0"},
      {"material.friction", "expected KEY=VALUE"},
      {"=1", "expected KEY=VALUE"},
      {"material..friction=1", "has an empty key"},
      {"blocks[0]high_m=1", "expected '.' or '['"},
      {"grid.cells=[1, 2", "expected a TOML value"},
      {"material.friction=", "expected a TOML value"},
      {"name=1\nother=2", "more than a value"},
  };
  for (const auto& [text, message] : wrong) {
    try {
      engine::with_overrides(kScene, std::vector{text});
      ADD_FAILURE() << text << " was taken";
    } catch (const problems::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(message)) << text;
    }
  }
}

TEST(SceneOverrides, AreNamedInLaterErrors) {
  const std::vector<std::string> overrides = {"name=1"};
  EXPECT_THAT(engine::with_overrides(kScene, overrides).subject, HasSubstr("heap with"));
}

}  // namespace
}  // namespace conebench::harness
