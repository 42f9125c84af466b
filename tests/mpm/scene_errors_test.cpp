#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/mpm/scene_texts.h"

namespace conebench::test {
namespace {

using testing::HasSubstr;

// What is done to kScene or kFull, and what the error must say: key, found, expected.
struct Mistake {
  std::string from, to;
  std::vector<std::string> says;
};

void expect_refused(const std::string& scene, const std::vector<Mistake>& mistakes) {
  for (const Mistake& mistake : mistakes) {
    const std::string error = error_of(changed(scene, mistake.from, mistake.to));
    EXPECT_THAT(error, HasSubstr("heap.toml: line ")) << mistake.to;
    for (const std::string& part : mistake.says) EXPECT_THAT(error, HasSubstr(part)) << mistake.to;
  }
}

TEST(MpmScene, GridAndHeaderAreChecked) {
  expect_refused(
      kScene,
      {{"\"mpm\"", "\"dem\"", {"line 2: engine: found \"dem\", expected \"mpm\""}},
       {"[grid]", "[gird]", {"grid: missing, expected a table"}},
       {"[40, 20]", "[40]", {"line 8: grid.cells: found an array of 1, expected", "2 to 3"}},
       {"[40, 20]", "[40, 0]", {"grid.cells: found 0", "expected an integer >= 1", "line 8"}},
       {"[40, 20]", "[4.5, 2]", {"grid.cells: found a number, expected", "integer >= 1"}},
       {"[40, 20]", "[100000, 100000]", {"grid.cells: found", "nodes, expected at most"}},
       {"[40, 20]",
        "[30000, 30000]\nrefine = \"boundary\"",
        {"grid.cells: found 3600120001 nodes, expected at most"}},
       {"[2, 1]",
        "[2, 1]\nrefine = \"boundry\"",
        {"line 10: grid.refine: found \"boundry\", expected one of \"none\", \"boundary\"",
         "(did you mean 'boundary'?)"}},
       {"[2, 1]", "[2, 1]\nrefine = true", {"grid.refine: found a boolean, expected one of"}},
       {"[2, 1]", "[2, 1, 1]", {"grid.size_m: found an array of 3, expected an array of 2"}},
       {"[2, 1]", "[2, -1]", {"grid.size_m: found -1, expected a number > 0"}},
       {"step_s", "cfl = 0\nstep_s", {"cfl: found 0, expected a number in (0, 1]"}},
       {"step_s", "cffl = 0.5\nstep_s", {"line 4: cffl: unknown key", "'cfl'"}},
       {"step_s",
        "gravity_m_s2 = [0, -9.81, 1]\nstep_s",
        {"gravity_m_s2: found [0, -9.81, 1], "
         "expected a third entry of 0"}}});
}

TEST(MpmScene, MaterialIsChecked) {
  expect_refused(
      kScene,
      {{"[material]", "[materials]", {"material: missing, expected a table"}},
       {"= 1500", "= 0", {"line 12: material.density_kg_m3: found 0, expected a number > 0"}},
       {"= 0.4", "= 0.4\nphi_max = 1.1", {"phi_max: found 1.1, expected a number in (0, 1]"}},
       {"= 0.4", "= 0\ncohesion_Pa = 1", {"material.friction: found 0, expected a number > 0"}},
       {"= 0.4", "= 0.4\nfriction_rise = 1", {"grain_diameter_m: found 0, expected a number > 0"}},
       {"= 0.4",
        "= 0.4\nlaw = \"monoton\"",
        {"law: found \"monoton\", expected one of \"uniform\"", "(did you mean 'monotone'?)"}},
       {"= 0.4", "= 0.4\nlaw = 3", {"material.law: found an integer, expected one of"}},
       {"= 0.4", "= 0.4\ncohesion = 3", {"material.cohesion: unknown key"}}});
}

TEST(MpmScene, WallsAreChecked) {
  const auto walls = [](const std::string& line) { return "[walls]\n" + line + "\n[material]"; };
  expect_refused(
      kScene, {{"[material]", walls("botom = \"slip\""), {"walls.botom: unknown key", "'bottom'"}},
               {"[material]", walls("front = \"slip\""), {"line 12: walls.front: unknown key"}},
               {"[material]",
                walls("left = \"slipp\""),
                {"found \"slipp\", expected one of \"stick\"", "'slip'"}},
               {"[material]", walls("left = 3"), {"walls.left: found an integer, expected one of"}},
               {"[material]",
                walls("left = \"frictional\""),
                {"walls.left: found \"frictional\" without", "expected { condition"}},
               {"[material]",
                walls("left = { condition = \"frictional\" }"),
                {"walls.left.friction: missing, expected a number >= 0"}},
               {"[material]",
                walls("left = { condition = \"frictional\", friction = -1 }"),
                {"walls.left.friction: found -1, expected a number >= 0"}},
               {"[material]",
                walls("left = { condition = \"stick\", friction = 1 }"),
                {"walls.left.friction: found 1, expected none", "\"stick\""}}});
}

TEST(MpmScene, BarriersAreChecked) {
  expect_refused(
      kFull,
      {{"axis = \"x\"", "axis = \"w\"", {"barriers[0].axis: found \"w\", expected one of \"x\""}},
       {"= 0.5\nlow_m",
        "= 0.52\nlow_m",
        {"barriers[0].position_m: found 0.52, expected a plane", "the nearest are 0.5 and 0.6"}},
       {"= 0.5\nlow_m", "= 1\nlow_m", {"position_m: found 1, expected", "the nearest is 0.9"}},
       {"= 0.5\nlow_m", "= -7\nlow_m", {"position_m: found -7", "the nearest is -0.9"}},
       {"high_m = [0, 1.1, 0.6]",
        "high_m = [0, 1.2, 0.6]",
        {"barriers[0].high_m: found [0, 1.2, 0.6], expected a point of the grid, from [-1, 0.1, 0]",
         "a barrier cannot cross a wall"}},
       {"low_m = [0, 0.1, 0]", "low_m = [-2, 0.1, 0]", {"barriers[0].low_m: found [-2, 0.1, 0]"}},
       {"high_m = [0, 1.1, 0.6]",
        "high_m = [0, 0.1, 0.6]",
        {"barriers[0].high_m: found 0.1 on axis y, expected > 0.1"}},
       {"condition = \"stick\"\n",
        "condition = \"free\"\n",
        {"condition: found \"free\", expected"}},
       {"opens_s = 0.1\n", "", {"opening_m_s: found 2 without opens_s, expected the two"}},
       {"[0, 0, -9.81]",
        "[9.81, 0, 0]",
        {"opening_m_s: found 2 where gravity_m_s2 = [9.81, 0, 0]",
         "expected gravity along an axis other than"}},
       {"[0, 0, -9.81]", "[0, 1, -9]", {"barriers[0].opening_m_s: found 2"}}});
}

TEST(MpmScene, BarriersNeedAPlaneOfNodes) {
  const std::string door =
      "\n[[barriers]]\naxis = \"y\"\nposition_m = 0.5\nlow_m = [0, 0]\nhigh_m = [1, 0]\n";
  EXPECT_EQ(error_of(kScene + door), "no error");
  EXPECT_THAT(error_of(changed(kScene, "[40, 20]", "[40, 1]") + door),
              HasSubstr("barriers[0].axis: found y, expected an axis with planes of nodes"));
}

TEST(MpmScene, BlocksAreChecked) {
  const std::string second = "[[blocks]]\nlow_m = [0.4, 0.4]\nhigh_m = [0.6, 0.6]\n[[blocks]]";
  expect_refused(
      kScene,
      {{"[[blocks]]\nlow_m = [0, 0]\nhigh_m = [0.5, 0.5]",
        "",
        {"blocks: found none, expected at "
         "least one: no particles"}},
       {"[0.5, 0.5]",
        "[2.5, 0.5]",
        {"line 17: blocks[0].high_m: found [2.5, 0.5], expected a point "
         "of the grid, from [0, 0] to [2, 1]"}},
       {"[0.5, 0.5]", "[0.5, 0.5, 0]", {"blocks[0].high_m: found an array of 3, expected"}},
       {"[0.5, 0.5]", "[0.5, 0]", {"blocks[0].high_m: found 0 on axis y, expected > 0"}},
       {"[0.5, 0.5]", "[0.5, 0.5]\nfraction = 0", {"fraction: found 0, expected a number > 0"}},
       {"= 0.4",
        "= 0.4\nphi_max = 0.6\n[[blocks]]\nlow_m = [1, 0]\nhigh_m = [2, 1]\nfraction = 0.7",
        {"blocks[0].fraction: found 0.7, expected at most material.phi_max, 0.6"}},
       {"[0.5, 0.5]", "[0.5, 0.5]\njitter = 2", {"jitter: found 2, expected a number in [0, 1]"}},
       {"[0.5, 0.5]", "[0.5, 0.5]\nparticles_per_cell = 0", {"found 0, expected an integer >= 1"}},
       {"[0.5, 0.5]",
        "[0.5, 0.5]\nvelocity_m_s = [1, 0, 2]",
        {"blocks[0].velocity_m_s: found [1, 0, 2], expected a third entry of 0"}},
       {"[[blocks]]",
        second,
        {"blocks[1].low_m: found [0, 0] to [0.5, 0.5], expected no volume in "
         "common with blocks[0], [0.4, 0.4] to [0.6, 0.6]"}}});
}

TEST(MpmScene, BodiesAreChecked) {
  expect_refused(
      kFull,
      {{"\"ball\"", "\"bal\"", {"bodies[0].shape: found \"bal\", expected one of", "'ball'"}},
       {"\"ball\"", "\"box\"", {"bodies[0].half_size_m: missing, expected an array of 3 numbers"}},
       {"radius_m = 0.15",
        "radius_m = 0.15\nnormal = [0, 0, 1]",
        {"bodies[0].normal: unknown key"}},
       {"radius_m = 0.15",
        "radius_m = 0.05",
        {"bodies[0].radius_m: found 0.05, expected at least "
         "0.1",
         "two cells thick"}},
       {"[0.1, 0.2, 0.3]", "[0.1, 0.01, 1]", {"bodies[1].half_size_m: found 0.01, expected"}},
       {"\"free\"\ncentre", "\"fre\"\ncentre", {"bodies[0].motion: found \"fre\"", "'free'"}},
       {"density_kg_m3 = 2500\n", "", {"bodies[0].density_kg_m3: missing, expected a number > 0"}},
       {"\"free\"\ncentre",
        "\"driven\"\ncentre",
        {"bodies[0].density_kg_m3: found 2500, expected "
         "none",
         "\"driven\""}},
       {"velocity_m_s = [0, 0, 0]",
        "velocity_m_s = [1, 0, 0]",
        {"bodies[1].velocity_m_s: found [1, 0, 0], expected zeros: a static body does not move"}},
       {"rad_s = [0, 0, 0]",
        "rad_s = [0, 1, 0]",
        {"bodies[1].angular_velocity_rad_s: found [0, 1, 0], expected zeros"}},
       {"normal = [0, 0, 1]",
        "normal = [0, 0, 0]",
        {"bodies[2].normal: found a zero vector, "
         "expected a direction"}},
       {"\"driven\"",
        "\"free\"\ndensity_kg_m3 = 1",
        {"bodies[2].motion: found \"free\", expected "
         "\"static\" or \"driven\""}}});
}

TEST(MpmScene, BodiesTurnAboutZInTwoDimensions) {
  const std::string disc =
      "\n[[bodies]]\nshape = \"ball\"\nradius_m = 0.1\nmotion = \"driven\"\ncentre_m = [1, 0.5]\n";
  EXPECT_EQ(error_of(kScene + disc + "rotation_rad = [0, 0, 1]\n"), "no error");
  EXPECT_THAT(error_of(kScene + disc + "rotation_rad = [0, 1, 0]\n"),
              HasSubstr("bodies[0].rotation_rad: found [0, 1, 0], expected [0, 0, angle]"));
  EXPECT_THAT(error_of(kScene + disc + "angular_velocity_rad_s = [2, 0, 0]\n"),
              HasSubstr("bodies[0].angular_velocity_rad_s: found [2, 0, 0], expected"));
}

}  // namespace
}  // namespace conebench::test
