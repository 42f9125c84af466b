#include "dem/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "dem/placement.h"
#include "problems/error.h"
#include "tests/engine/scene_text.h"

namespace conebench::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kScene = R"(schema = 1
engine = "dem"
name = "two"
step_s = 1e-3
duration_s = 0.3
skin_m = 1e-3

[[materials]]
name = "glass"
density_kg_m3 = 2500

[[pairs]]
between = ["glass", "glass"]
friction = 0.5

[[planes]]
normal = [0, 0, 1]
material = "glass"

[[bodies]]
position_m = [0, 0, 0.5]
radius_m = 0.1
material = "glass"

[[bodies]]
position_m = [0, 0, 0.8]
radius_m = 0.1
material = "glass"
)";

std::string changed(const std::string& from, const std::string& to) {
  return test::changed(kScene, from, to);
}

std::string error_of(const std::string& text) {
  return input_error("two.toml", [&] { dem::parse_scene(text, "two.toml"); });
}

TEST(Scene, ReadsWhatIsWrittenAndFillsInDefaults) {
  const dem::Scene scene = dem::parse_scene(kScene, "two.toml");
  EXPECT_EQ(scene.name, "two");
  EXPECT_EQ(scene.step_count(), 300);
  EXPECT_EQ(scene.gravity_m_s2, Eigen::Vector3d(0.0, 0.0, -9.81));
  EXPECT_EQ(scene.solver.name, "auto");
  EXPECT_EQ(scene.bodies.size(), 2u);
  EXPECT_EQ(dem::law_between(scene, "glass", "glass")->friction, 0.5);
}

TEST(Scene, PrintedSceneReadsBackTheSame) {
  for (const engine::BuiltinScene& scene : dem::builtin_scenes()) {
    const std::string text = dem::to_toml(dem::parse_scene(scene.text, scene.name));
    EXPECT_EQ(dem::to_toml(dem::parse_scene(text, scene.name)), text);
  }
  std::string odd = changed("name = \"two\"", "name = \"a \\\"b\\\" \\\\ c\"");
  odd += "velocity_m_s = [0.1, 1e-17, 3]\nangular_velocity_rad_s = [0, 0.3333333333333333, 0]\n";
  const std::string text = dem::to_toml(dem::parse_scene(odd, "odd"));
  EXPECT_EQ(dem::to_toml(dem::parse_scene(text, "odd")), text);
  EXPECT_THAT(text, HasSubstr("0.3333333333333333"));
}

TEST(Scene, BuiltinsCarryTheirOwnNames) {
  std::vector<std::string> names;
  for (const engine::BuiltinScene& scene : dem::builtin_scenes()) names.emplace_back(scene.name);
  EXPECT_THAT(names, testing::IsSupersetOf({"sphere-on-slope", "bouncing-sphere", "stack",
                                            "column-dry", "column-cohesive"}));
  for (const std::string& name : names) EXPECT_EQ(dem::load_scene(name).name, name);
}

TEST(Scene, UnknownNameComesWithASuggestion) {
  try {
    dem::load_scene("colum-dry");
    FAIL() << "expected an InputError";
  } catch (const problems::InputError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("colum-dry"), HasSubstr("'column-dry'")));
  }
  EXPECT_THROW(dem::load_scene("no/such/file.toml"), problems::InputError);
}

TEST(Scene, UnknownKeyNamesFileLineAndSuggestion) {
  EXPECT_THAT(error_of(changed("friction", "fricton")),
              AllOf(HasSubstr("two.toml: line 12"), HasSubstr("pairs[0].friction: missing")));
  EXPECT_THAT(error_of(changed("friction = 0.5", "friction = 0.5\nrestituton = 0.1")),
              AllOf(HasSubstr("line 15"), HasSubstr("pairs[0].restituton: unknown key"),
                    HasSubstr("'restitution'")));
  EXPECT_THAT(error_of(changed("skin_m", "skn_m = 1\nskin_m")),
              AllOf(HasSubstr("line 6"), HasSubstr("skn_m"), HasSubstr("'skin_m'")));
}

TEST(Scene, WrongNumbersNameKeyFoundAndExpected) {
  EXPECT_THAT(error_of(changed("2500", "-3")),
              HasSubstr("line 10: materials[0].density_kg_m3: found -3, expected a number > 0"));
  EXPECT_THAT(error_of(changed("radius_m = 0.1", "radius_m = 0")),
              HasSubstr("bodies[0].radius_m: found 0, expected a number > 0"));
  EXPECT_THAT(error_of(changed("radius_m = 0.1", "radius_m = nan")), HasSubstr("found nan"));
  EXPECT_THAT(error_of(changed("1e-3", "inf")), HasSubstr("step_s: found inf"));
  EXPECT_THAT(error_of(changed("friction = 0.5", "friction = -0.5")), HasSubstr("found -0.5"));
  EXPECT_THAT(error_of(changed("friction = 0.5", "friction = 0.5\nrestitution = 1.5")),
              HasSubstr("found 1.5, expected a number in [0, 1]"));
}

TEST(Scene, WrongTypesNameKeyFoundAndExpected) {
  EXPECT_THAT(error_of(changed("2500", "\"heavy\"")),
              HasSubstr("found a string, expected a number > 0"));
  EXPECT_THAT(error_of(changed("[0, 0, 0.5]", "[0, 0.5]")),
              HasSubstr("found an array of 2, expected an array of 3 numbers"));
  EXPECT_THAT(error_of(changed("\"two\"", "2")), HasSubstr("found an integer, expected a string"));
  EXPECT_THAT(error_of(changed("schema = 1", "schema = 1.0")), HasSubstr("expected an integer"));
  EXPECT_THAT(error_of(changed("skin_m", "resolve = 1\nskin_m")),
              HasSubstr("expected true or false"));
  EXPECT_THAT(error_of(changed("[[planes]]", "[planes]")), HasSubstr("an array of tables"));
}

TEST(Scene, MissingKeysAndWrongHeadersAreRefused) {
  EXPECT_THAT(error_of(changed("step_s = 1e-3\n", "")),
              HasSubstr("step_s: missing, expected a number > 0"));
  EXPECT_THAT(error_of(changed("schema = 1", "schema = 2")), HasSubstr("found 2, expected 1"));
  EXPECT_THAT(error_of(changed("\"dem\"", "\"mpm\"")), HasSubstr("found \"mpm\""));
  EXPECT_THAT(error_of("name = \n"), HasSubstr("line 1: not TOML"));
}

TEST(Scene, MaterialsAndLawsMustBeThere) {
  EXPECT_THAT(error_of(changed("0.1\nmaterial = \"glass\"", "0.1\nmaterial = \"glas\"")),
              AllOf(HasSubstr("no material \"glas\""), HasSubstr("'glass'")));
  EXPECT_THAT(error_of(changed("[[pairs]]\nbetween = [\"glass\", \"glass\"]\nfriction = 0.5", "")),
              HasSubstr("no law between \"glass\" and \"glass\""));
  EXPECT_EQ(error_of(changed("[[pairs]]\nbetween = [\"glass\", \"glass\"]", "[default_pair]")),
            "no error");
}

TEST(Scene, CohesionNeedsFrictionAndARuptureDistance) {
  EXPECT_THAT(error_of(changed("friction = 0.5",
                               "friction = 0\ntensile_force_N = 1\n"
                               "rupture_distance_m = 1e-4")),
              HasSubstr("needs friction > 0"));
  EXPECT_THAT(error_of(changed("friction = 0.5", "friction = 0.5\ntensile_force_N = 1")),
              HasSubstr("rupture_distance_m: found 0"));
}

TEST(Scene, OverlapsNameThePairUnlessTheyAreResolved) {
  EXPECT_THAT(error_of(changed("[0, 0, 0.8]", "[0, 0, 0.69]")),
              AllOf(HasSubstr("body 0 and body 1 overlap by 0.01"), HasSubstr("resolve")));
  EXPECT_THAT(error_of(changed("[0, 0, 0.5]", "[0, 0, 0.05]")),
              HasSubstr("body 0 and plane 0 overlap by 0.05"));
  std::string text = changed("[0, 0, 0.8]", "[0, 0.05, 0.5]");
  text.insert(text.find("skin_m"), "resolve = true\n");
  const dem::Scene scene = dem::parse_scene(text, "two.toml");
  const dem::Bodies spheres = dem::place_bodies(scene, "two").bodies;
  EXPECT_GE((spheres.position[0] - spheres.position[1]).norm(), 0.2 * (1.0 - 1e-6));
}

TEST(Scene, StepsInWhichBodiesPassEachOtherAreRefused) {
  EXPECT_THAT(error_of(changed("step_s = 1e-3", "step_s = 0.2")),
              AllOf(HasSubstr("step_s: found 0.2, in which body 0 starts by moving 0.392"),
                    HasSubstr("expected at most 0.2 m, its thickness")));
  EXPECT_EQ(error_of(changed("step_s = 1e-3", "step_s = 0.1")), "no error");
  const std::string fast = kScene + "velocity_m_s = [0, 300, 0]\n";
  EXPECT_THAT(error_of(fast), HasSubstr("body 1 starts by moving 0.3"));
}

TEST(Scene, FixedBodiesCannotMove) {
  EXPECT_THAT(error_of(kScene + "fixed = true\nvelocity_m_s = [1, 0, 0]\n"),
              HasSubstr("bodies[1].velocity_m_s: a fixed body does not move"));
}

TEST(Scene, BedsAreHeldInPlace) {
  const std::string bed = "[[beds]]\nwidth_m = 0.5\nradius_m = 0.1\nmaterial = \"glass\"\n";
  const dem::Scene scene = dem::parse_scene(kScene + bed, "bed");
  const dem::Bodies spheres = dem::place_bodies(scene, "bed").bodies;
  ASSERT_EQ(spheres.count(), 2 + 9);
  EXPECT_EQ(spheres.dofs, 12);
  EXPECT_LT((spheres.position[2] - Eigen::Vector3d(-0.2, -0.2, 0.0)).norm(), 1e-15);
  const std::string text = dem::to_toml(scene);
  EXPECT_EQ(dem::to_toml(dem::parse_scene(text, "bed")), text);
}

TEST(Scene, ColumnsFillTheirSection) {
  std::string text = kScene.substr(0, kScene.find("[[bodies]]"));
  text +=
      "[[columns]]\nsection = \"cylinder\"\nwidth_m = 0.1\nheight_m = 0.1\n"
      "radius_range_m = [0.005, 0.01]\nmaterial = \"glass\"\n";
  const dem::Scene scene = dem::parse_scene(text, "column");
  const dem::Bodies spheres = dem::place_bodies(scene, "column").bodies;
  EXPECT_EQ(spheres.count(), 5 * 13);
  for (std::size_t i = 0; i < static_cast<std::size_t>(spheres.count()); ++i) {
    EXPECT_LE(spheres.position[i].head<2>().norm() + spheres.radius[i], 0.05 + 1e-3);
    EXPECT_GE(spheres.position[i].z(), spheres.radius[i] * (1.0 - 1e-12));
  }
  EXPECT_THAT(error_of(text.replace(text.find("height_m = 0.1"), 14, "height_m = 0.01")),
              HasSubstr("does not fit"));
  EXPECT_THAT(error_of(test::changed(text, "height_m = 0.01", "height_m = 1e9")),
              HasSubstr("columns: asks for 1.25e+12 bodies, expected at most 1e+08"));
}

}  // namespace
}  // namespace conebench::test
