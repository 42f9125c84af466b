#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "dem/shape.h"
#include "tests/dem/shape_helper.h"
#include "tests/engine/scene_text.h"

namespace conebench::test {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::string error_of(const dem::Piece& piece, bool closed = false) {
  return input_error("brick", [&] { dem::check_piece(piece, "brick", closed); });
}

dem::Mesh cube() { return box_mesh({0.5, 0.5, 0.5}); }

TEST(CheckPiece, TakesWhatIsSound) {
  for (const dem::Piece& piece : one_of_each_solid()) EXPECT_EQ(error_of(piece), "no error");
  EXPECT_EQ(error_of(cube(), true), "no error");
  EXPECT_EQ(error_of(dem::Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}}), "no error");
  EXPECT_EQ(error_of(dem::Hull{grid({1.0, 1.0, 1e-6}, 3)}), "no error");
  EXPECT_EQ(error_of(box_mesh({1.0, 1.0, 1e-6}), true), "no error");
}

TEST(CheckPiece, NamesTheSizeThatIsNotPositiveAndFinite) {
  for (const double size : {0.0, -1.0, kNan, kInfinity}) {
    EXPECT_THAT(error_of(dem::Ball{size}), HasSubstr("brick: radius_m is "));
    EXPECT_THAT(error_of(dem::Capsule{size, 1.0}), HasSubstr("radius_m is "));
    EXPECT_THAT(error_of(dem::Capsule{1.0, size}), HasSubstr("half_length_m is "));
    EXPECT_THAT(error_of(dem::Cylinder{size, 1.0}), HasSubstr("radius_m is "));
    EXPECT_THAT(error_of(dem::Cylinder{1.0, size}), HasSubstr("half_length_m is "));
    EXPECT_THAT(error_of(dem::Box{{1.0, size, 1.0}}), HasSubstr("half_m is "));
  }
  EXPECT_EQ(error_of(dem::Ball{-1.0}), "brick: radius_m is -1, expected > 0 and finite");
}

TEST(CheckPiece, RefusesAHullWithoutVolume) {
  EXPECT_THAT(error_of(dem::Hull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}),
              HasSubstr("a hull of 3 points, expected at least 4"));
  EXPECT_THAT(error_of(dem::Hull{grid({1.0, 1.0, 0.0}, 3)}),
              HasSubstr("all 27 points of the hull lie in a plane"));
  EXPECT_THAT(error_of(dem::Hull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, kNan, 1}}}),
              HasSubstr("point 3 is (  0 nan   1), expected finite"));
}

TEST(CheckPiece, NamesTheTriangleThatCannotBe) {
  EXPECT_THAT(error_of(dem::Mesh{}), HasSubstr("a mesh of no triangles"));

  dem::Mesh mesh = cube();
  mesh.triangles[3](1) = 8;
  EXPECT_THAT(error_of(mesh), HasSubstr("triangle 3 has vertex 8, expected 0 to 7"));
  mesh.triangles[3](1) = -1;
  EXPECT_THAT(error_of(mesh), HasSubstr("triangle 3 has vertex -1, expected 0 to 7"));

  mesh = cube();
  mesh.triangles[5] = {4, 4, 7};
  EXPECT_THAT(error_of(mesh), HasSubstr("triangle 5 of vertices 4 4 7 has no area"));
  mesh = cube();
  mesh.vertices_m.emplace_back(0.0, -0.5, -0.5);  // between 0 and 1
  mesh.triangles[2] = {0, 8, 1};
  EXPECT_THAT(error_of(mesh), HasSubstr("triangle 2 of vertices 0 8 1 has no area"));

  mesh = cube();
  mesh.vertices_m[6].y() = kInfinity;
  EXPECT_THAT(error_of(mesh), HasSubstr("vertex 6 is "));
}

TEST(CheckPiece, WantsTheEdgesOfAClosedMeshInPairs) {
  dem::Mesh open = cube();
  open.triangles.pop_back();
  EXPECT_EQ(error_of(open), "no error");
  EXPECT_THAT(error_of(open, true),
              EndsWith("is part of 1 triangles and the edge back of 0, expected one each: a closed "
                       "surface, all triangles turned the same way"));

  dem::Mesh turned = cube();
  std::swap(turned.triangles[4](0), turned.triangles[4](1));
  EXPECT_EQ(error_of(turned), "no error");
  EXPECT_THAT(error_of(turned, true), HasSubstr("is part of 2 triangles and the edge back of 0"));

  dem::Mesh doubled = cube();
  doubled.triangles.push_back(doubled.triangles.front());
  EXPECT_THAT(error_of(doubled, true), HasSubstr("is part of 2 triangles and the edge back of 1"));
}

TEST(CheckPiece, WantsTheVolumeOfAClosedMeshPositive) {
  dem::Mesh inside_out = cube();
  for (Eigen::Vector3i& triangle : inside_out.triangles) std::swap(triangle(0), triangle(1));
  EXPECT_EQ(error_of(inside_out), "no error");
  EXPECT_EQ(error_of(inside_out, true),
            "brick: the volume is -1 m3, expected > 0: the mesh is inside out");

  // Both sides of one triangle, turned so that rounding leaves a volume.
  const dem::Mesh sheet{moved({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, Draw(2).pose()),
                        {{0, 1, 2}, {0, 2, 1}}};
  EXPECT_THAT(error_of(sheet, true), HasSubstr("the mesh encloses no volume"));
  EXPECT_THAT(error_of(box_mesh({1.0, 1.0, 1e-11}), true),
              HasSubstr("the mesh encloses no volume"));
}

}  // namespace
}  // namespace conebench::test
