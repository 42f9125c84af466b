#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>

#include "dem/generators/extent.h"
#include "tests/dem/generators/made.h"
#include "tests/engine/scene_text.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using testing::AllOf;
using testing::HasSubstr;

std::string deposition(const std::string& keys) {
  return made_head() + "[[depositions]]\nlow_m = [0, 0, 0]\nhigh_m = [0.2, 0.2, 0.3]\n" + keys +
         kStone;
}

TEST(Deposition, FillsItsBoxWithBallsOfTheRange) {
  const std::string text = deposition("radius_range_m = [0.01, 0.02]\n");
  const Made made(text);
  EXPECT_EQ(made.bodies.count(), 5 * 5 * 7);
  EXPECT_TRUE(
      Eigen::AlignedBox3d(Vector3d::Zero(), Vector3d(0.2, 0.2, 0.3)).contains(made.bounds()));
  double mass = 0.0;
  for (const double radius : made.bodies.radius) {
    EXPECT_GE(radius, 0.01);
    EXPECT_LE(radius, 0.02);
    mass += ball_mass(radius);
  }
  EXPECT_NEAR(made.mass_kg(), mass, 1e-12 * mass);
  expect_same_places(text, true);
}

TEST(Deposition, ShapesAreTakenInTurnAndTurnedAtRandom) {
  const std::string text = deposition(
      "shapes = [\"box\", \"capsule\", \"hammer\"]\ncount = 10\nvelocity_m_s = [0, 0, -2]\n");
  const Made made(text);
  EXPECT_THAT(made.bodies.solid, testing::ElementsAre(0, 1, 2, 0, 1, 2, 0, 1, 2, 0));
  for (const Vector3d& v : made.bodies.velocity) EXPECT_EQ(v, Vector3d(0.0, 0.0, -2.0));
  EXPECT_GT(made.bodies.orientation[0].angularDistance(made.bodies.orientation[3]), 0.1);
  EXPECT_TRUE(
      Eigen::AlignedBox3d(Vector3d::Zero(), Vector3d(0.2, 0.2, 0.3)).contains(made.bounds()));
  expect_same_places(text, true);
  const Made random(changed(text, "count = 10", "order = \"random\"\ncount = 16"));
  std::array<int, 3> counts{};
  for (const int solid : random.bodies.solid) ++counts[static_cast<std::size_t>(solid)];
  for (const int count : counts) EXPECT_GT(count, 0);
}

TEST(Deposition, WithoutJitterBodiesAreInTheMiddleOfEqualCells) {
  const Made made(deposition("radius_range_m = [0.03, 0.03]\njitter = 0\n"));
  ASSERT_EQ(made.bodies.count(), 3 * 3 * 5);
  EXPECT_LT((made.bodies.position[0] - Vector3d(0.2 / 6, 0.2 / 6, 0.03)).norm(), 1e-15);
  EXPECT_LT((made.bodies.position[44] - Vector3d(1.0 / 6, 1.0 / 6, 0.27)).norm(), 1e-15);
}

TEST(Deposition, InThePlaneThereIsOneRowTurnedAboutY) {
  const Made made(in_the_plane(deposition("shapes = [\"box\"]\n")));
  const double side = 2.0 * dem::extent_of(made.placement.solids[0]).radius_m;
  EXPECT_EQ(made.bodies.count(), static_cast<int>(0.2 / side) * static_cast<int>(0.3 / side));
  for (const Vector3d& x : made.bodies.position) EXPECT_EQ(x.y(), 0.0);
  const dem::Pose& from_shape = made.placement.solids[0].from_shape;
  for (const Eigen::Quaterniond& q : made.bodies.orientation) {
    const Vector3d axis = q * from_shape.orientation * Vector3d::UnitY();
    EXPECT_LT((axis - Vector3d::UnitY()).norm(), 1e-15);
  }
}

TEST(Deposition, WhatCannotBeIsRefused) {
  EXPECT_THAT(error_of(deposition("radius_range_m = [1e-6, 1e-6]\n")),
              HasSubstr("depositions: asks for "));
  EXPECT_THAT(error_of(deposition("radius_range_m = [0.02, 0.02]\ncount = 176\n")),
              HasSubstr("depositions: count: 176 cells of side 0.04 m do not fit into "
                        "low_m..high_m, there is room for 175"));
  EXPECT_THAT(error_of(deposition("radius_range_m = [0.02, 0.11]\n")), HasSubstr("room for 0"));
  EXPECT_THAT(error_of(deposition("radius_range_m = [0.02, 0.02]\ncount = 0\n")),
              HasSubstr("depositions[0].count: found 0"));
  EXPECT_THAT(error_of(deposition("shapes = [\"box\", \"capsul\"]\n")),
              AllOf(HasSubstr("depositions: no shape \"capsul\""), HasSubstr("'capsule'")));
  EXPECT_THAT(error_of(deposition("shapes = [\"box\"]\nradius_range_m = [1, 2]\n")),
              HasSubstr("radius_range_m: unknown key"));
  EXPECT_THAT(error_of(changed(deposition("shapes = [\"box\"]\n"), "0.3]", "0]")),
              HasSubstr("high_m: expected above low_m"));
  EXPECT_THAT(error_of(in_the_plane(deposition("shapes = [\"box\"]\nvelocity_m_s = [0, 1, 0]\n"))),
              HasSubstr("depositions: velocity_m_s: found y = 1"));
  expect_material_is_checked(deposition("shapes = [\"box\"]\n"));
}

}  // namespace
}  // namespace conebench::test
