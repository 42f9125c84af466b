#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/generators/extent.h"
#include "tests/dem/generators/made.h"
#include "tests/engine/scene_text.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;
using testing::AllOf;
using testing::HasSubstr;

std::string lattice(const std::string& keys) {
  return made_head() + "[[lattices]]\n" + keys + kStone;
}

TEST(Lattice, BallsOnACubicLatticeTouchAlongTheAxes) {
  const Made made(lattice("radius_m = 0.01\nbase_m = [1, 2, 3]\ncounts = [3, 2, 4]\n"));
  EXPECT_EQ(made.bodies.count(), 24);
  EXPECT_EQ(made.touching().size(), 2u * 2 * 4 + 3 * 1 * 4 + 3 * 2 * 3);
  EXPECT_NEAR(made.mass_kg(), 24 * ball_mass(0.01), 1e-12);
  expect_box(made, {0.97, 1.98, 3.0}, {1.03, 2.02, 3.08});
}

TEST(Lattice, BallsOnAnFccLatticeTouchTwelveOthers) {
  const Made made(lattice("radius_m = 0.01\narrangement = \"fcc\"\ncounts = [5, 5, 5]\n"));
  ASSERT_EQ(made.bodies.count(), 125);
  EXPECT_EQ(made.touching(62), 12u);
  const double height = 0.02 + 4 * 0.02 / std::numbers::sqrt2;
  expect_box(made, {-0.055, -0.055, 0.0}, {0.055, 0.055, height});
}

TEST(Lattice, InThePlaneFccIsTriangular) {
  const std::string text =
      in_the_plane(lattice("radius_m = 0.01\narrangement = \"fcc\"\ncounts = [5, 1, 5]\n"));
  const Made made(text);
  ASSERT_EQ(made.bodies.count(), 25);
  EXPECT_EQ(made.touching(12), 6u);
  EXPECT_THAT(error_of(changed(text, "[5, 1, 5]", "[5, 2, 5]")),
              HasSubstr("counts: found 2 along y, expected 1"));
}

TEST(Lattice, ShapesTouchWithTheirBoxes) {
  const Made boxes(lattice("shape = \"box\"\ncounts = [2, 3, 2]\n"));
  // With all of the 3 x 3 x 3 about them, edge to edge and corner to corner too.
  EXPECT_EQ(boxes.touching().size(), (4u * 7 * 4 - 12) / 2);
  EXPECT_NEAR(boxes.mass_kg(), 12 * 0.02 * 0.03 * 0.04 * kDensity, 1e-12);
  expect_box(boxes, {-0.02, -0.045, 0.0}, {0.02, 0.045, 0.08});
  const Made hammers(lattice("shape = \"hammer\"\ncounts = [2, 1, 1]\n"));
  expect_box(hammers, {-0.04, -0.01, 0.0}, {0.04, 0.01, 0.06});
  EXPECT_EQ(hammers.touching().size(), 1u);
}

TEST(Lattice, SpacingIsFromCentreToCentre) {
  const Made made(lattice("shape = \"box\"\ncounts = [2, 2, 2]\nspacing_m = [0.1, 0.2, 0.3]\n"));
  EXPECT_TRUE(made.touching().empty());
  expect_box(made, {-0.06, -0.115, 0.0}, {0.06, 0.115, 0.34});
  EXPECT_THAT(error_of(lattice("radius_m = 0.1\ncounts = [2, 1, 1]\nspacing_m = [0.1, 1, 1]\n")),
              HasSubstr("body 0 and body 1 overlap by 0.1"));
}

TEST(Lattice, TurnedShapesKeepToTheirCells) {
  const std::string text =
      lattice("shape = \"hammer\"\nrandom_rotation = true\ncounts = [4, 4, 4]\n");
  const Made made(text);
  const double reach = 4.0 * dem::extent_of(made.placement.solids[2]).radius_m;
  EXPECT_LE(made.bounds().max().x(), reach);
  EXPECT_GE(made.bounds().min().z(), 0.0);
  expect_same_places(text, true);
  expect_same_places(lattice("shape = \"hammer\"\ncounts = [2, 2, 2]\n"), false);
}

TEST(Lattice, WhatCannotBeIsRefused) {
  EXPECT_THAT(error_of(lattice("radius_m = 0.01\ncounts = [4294967297, 1, 1]\n")),
              HasSubstr("lattices[0].counts: found 4294967297, expected at most 1e+08"));
  EXPECT_THAT(error_of(lattice("radius_m = 0.01\ncounts = [1000, 1000, 1000]\n")),
              HasSubstr("lattices: counts: asks for 1e+09 bodies"));
  EXPECT_THAT(error_of(lattice("radius_m = 0.01\ncounts = [3, 0, 3]\n")),
              AllOf(HasSubstr("lattices[0].counts"), HasSubstr("found 0")));
  EXPECT_THAT(error_of(lattice("shape = \"bx\"\ncounts = [1, 1, 1]\n")),
              AllOf(HasSubstr("lattices: no shape \"bx\""), HasSubstr("'box'")));
  EXPECT_THAT(error_of(lattice("shape = \"box\"\narrangement = \"fcc\"\ncounts = [1, 1, 1]\n")),
              HasSubstr("arrangement: found fcc with a shape"));
  EXPECT_THAT(error_of(lattice("radius_m = 0.01\narrangement = \"fc\"\ncounts = [1, 1, 1]\n")),
              HasSubstr("'fcc'"));
  EXPECT_THAT(error_of(lattice("radius_m = 0.01\nrandom_rotation = true\ncounts = [1, 1, 1]\n")),
              HasSubstr("random_rotation: unknown key"));
  expect_material_is_checked(lattice("radius_m = 0.01\ncounts = [1, 1, 1]\n"));
}

std::string clump(const std::string& keys) {
  return made_head() + "[[clumps]]\ncentre_m = [1, 0, 3]\nball_radius_m = 0.01\n" + keys + kStone;
}

TEST(Clump, BallsTouchAsInTheDensestPacking) {
  const Made made(clump("radius_m = 0.03\nvelocity_m_s = [0, 0, -4]\n"));
  ASSERT_EQ(made.bodies.count(), 13);
  EXPECT_EQ(made.touching(6), 12u);
  EXPECT_EQ(made.touching().size(), 12u + 24);
  EXPECT_NEAR(made.mass_kg(), 13 * ball_mass(0.01), 1e-12);
  for (int i = 0; i < 13; ++i) {
    const auto k = static_cast<std::size_t>(i);
    EXPECT_LE((made.bodies.position[k] - Vector3d(1, 0, 3)).norm(), 0.02 * (1.0 + 1e-9));
    EXPECT_EQ(made.bodies.velocity[k], Vector3d(0.0, 0.0, -4.0));
  }
}

// Of a sphere they fill pi / sqrt(18) = 0.74 but for its rim, a ball's radius or two wide.
TEST(Clump, FillsItsSphere) {
  const Made made(clump("radius_m = 0.2\n"));
  const double share = made.bodies.count() / (20.0 * 20.0 * 20.0);
  EXPECT_LT(share, 0.7405);
  EXPECT_GT(share, 0.7405 * std::pow(18.0 / 20.0, 3));
}

TEST(Clump, InThePlaneItIsTriangular) {
  const Made made(in_the_plane(clump("radius_m = 0.03\n")));
  EXPECT_EQ(made.bodies.count(), 7);
  EXPECT_EQ(made.touching().size(), 12u);
}

TEST(Clump, WhatCannotBeIsRefused) {
  EXPECT_EQ(Made(clump("radius_m = 0.01\n")).bodies.count(), 1);
  EXPECT_THAT(error_of(clump("radius_m = 0.0099\n")),
              HasSubstr("clumps[0].ball_radius_m: found 0.01, expected at most radius_m = 0.0099"));
  expect_material_is_checked(clump("radius_m = 0.01\n"));
}

}  // namespace
}  // namespace conebench::test
