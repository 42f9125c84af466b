// Scenes that cannot be simulated as they stand: what is said of them, and what `resolve` makes of
// bodies that start inside each other.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "dem/simulation.h"
#include "tests/engine/scene_text.h"
#include "tests/engine/small_solver.h"

namespace conebench::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

const std::string kHead = R"(schema = 1
engine = "dem"
name = "bad"
step_s = 1e-3
duration_s = 0.3
skin_m = 1e-3

[default_pair]
friction = 0.5

[[materials]]
name = "stone"
density_kg_m3 = 2500

[[planes]]
normal = [0, 0, 1]
material = "stone"

)";

const std::string kBody = R"(
[[bodies]]
position_m = [0, 0, 1]
shape = "s"
material = "stone"
)";

std::string error_of(const std::string& text) {
  return input_error("bad.toml", [&] { dem::parse_scene(text, "bad.toml"); });
}

std::string with_shape(const std::string& lines, const std::string& more = "") {
  return kHead + "[[shapes]]\nname = \"s\"\n" + lines + kBody + more;
}

TEST(BadShape, SizesAreNamedAsTheSceneNamesThem) {
  EXPECT_THAT(error_of(with_shape("kind = \"box\"\nsize_m = [1, 0, 1]\n")),
              HasSubstr("shapes[0].size_m: found [1, 0, 1], expected numbers > 0"));
  EXPECT_THAT(error_of(with_shape("kind = \"capsule\"\nradius_m = -1\nlength_m = 1\n")),
              HasSubstr("shapes[0].radius_m: found -1"));
  EXPECT_THAT(error_of(with_shape("kind = \"cylinder\"\nradius_m = 1\nlength_m = nan\n")),
              HasSubstr("shapes[0].length_m: found nan"));
  EXPECT_THAT(error_of(with_shape("kind = \"bocks\"\nsize_m = [1, 1, 1]\n")), HasSubstr("\"box\""));
}

TEST(BadShape, HullsAndMeshesWithoutVolumeOrAreaAreRefused) {
  const auto refused = [](const std::string& lines) {
    return input_error("bad.toml: shape \"s\"",
                       [&] { dem::parse_scene(with_shape(lines), "bad.toml"); });
  };
  EXPECT_THAT(refused("kind = \"hull\"\npoints_m = [[0,0,0],[1,0,0],[0,1,0],[1,1,0]]\n"),
              HasSubstr("all 4 points of the hull lie in a plane"));
  EXPECT_THAT(refused("kind = \"mesh\"\nvertices_m = [[0,0,0],[1,0,0],[2,0,0]]\n"
                      "triangles = [[0,1,2]]\n"),
              HasSubstr("triangle 0 of vertices 0 1 2 has no area"));
  EXPECT_THAT(refused("kind = \"mesh\"\nvertices_m = [[0,0,0],[1,0,0],[0,1,0]]\n"
                      "triangles = [[0,1,3]]\n"),
              HasSubstr("triangle 0 has vertex 3, expected 0 to 2"));
}

TEST(BadShape, AMeshHasNoMassToFallWith) {
  EXPECT_THAT(error_of(with_shape("kind = \"mesh\"\nvertices_m = [[0,0,0],[1,0,0],[0,1,0]]\n"
                                  "triangles = [[0,1,2]]\n")),
              HasSubstr("body 0 has a mesh, which has no mass, expected fixed = true or a motion"));
}

// A tetrahedron's faces in a file, for a hull.
class HullFile : public testing::Test {
 protected:
  std::string error_of_faces(const std::string& faces) {
    const auto folder = std::filesystem::path(testing::TempDir());
    const auto file = folder / "tetrahedron.obj";
    std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n" << faces;
    const std::string scene = with_shape("kind = \"hull\"\nfile = \"tetrahedron.obj\"\n");
    const std::string error = input_error(
        file.string(), [&] { dem::parse_scene(scene, (folder / "bad.toml").string()); });
    std::filesystem::remove(file);
    return error;
  }
};

TEST_F(HullFile, InsideOutOrOpenIsRefused) {
  EXPECT_EQ(error_of_faces("f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"), "no error");
  EXPECT_THAT(error_of_faces("f 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n"),
              HasSubstr("the mesh is inside out"));
  EXPECT_THAT(error_of_faces("f 1 3 2\nf 1 2 4\nf 1 4 3\n"), HasSubstr("expected one each"));
  EXPECT_THAT(error_of_faces("f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 4 3\n"),
              HasSubstr("all triangles turned the same way"));
}

// Two boxes, a ball and a capsule, all inside each other.
std::string heap(const std::string& lines) {
  std::string text = lines + kHead + R"([[shapes]]
name = "box"
kind = "box"
size_m = [0.2, 0.1, 0.1]

[[shapes]]
name = "capsule"
kind = "capsule"
radius_m = 0.04
length_m = 0.1

[[bodies]]
position_m = [0, 0, 0.02]
shape = "box"
material = "stone"

[[bodies]]
position_m = [0.03, 0, 0.1]
rotation_rad = [0.3, 0, 0.5]
shape = "box"
material = "stone"

[[bodies]]
position_m = [-0.05, 0.02, 0.1]
shape = "capsule"
material = "stone"

[[bodies]]
position_m = [0, 0.03, 0.12]
radius_m = 0.05
material = "stone"
)";
  return text;
}

TEST(InterpenetratingStart, NamesTheFirstPairAndHowDeep) {
  EXPECT_THAT(error_of(heap("")),
              AllOf(HasSubstr("body 0 and "), HasSubstr(" overlap by 0.0"), HasSubstr("resolve")));
}

TEST(InterpenetratingStart, ResolvedDoesNotExplode) {
  const dem::Scene scene = dem::parse_scene(heap("resolve = true\n"), "heap");
  dem::Simulation simulation(scene, small_solver(1e-8));
  const dem::EnergyLedger& energy = simulation.energy();
  EXPECT_EQ(energy.kinetic_J, 0.0);
  for (int k = 0; k < 400; ++k) {
    simulation.step();
    // Whatever moves has fallen.
    EXPECT_LE(energy.kinetic_J, energy.initial_J - energy.potential_J + 1e-9);
  }
  EXPECT_LT(energy.kinetic_J, 0.1 * energy.initial_J);
  EXPECT_LT(simulation.summary().deepest_overlap_m, 1e-3);
}

TEST(InterpenetratingStart, WhatDoesNotFitIsRefused) {
  const std::string text = "resolve = true\n" + kHead + R"(
[[planes]]
point_m = [0, 0, 0.15]
normal = [0, 0, -1]
material = "stone"

[[bodies]]
position_m = [0, 0, 0.08]
radius_m = 0.1
material = "stone"
)";
  EXPECT_THAT(error_of(text), HasSubstr("the bodies do not fit, 10000 sweeps did not part them"));
}

}  // namespace
}  // namespace conebench::test
