#include <gtest/gtest.h>

#include <cmath>

#include "narrow_phase_helper.h"
#include "narrow_phase_oracle.h"
#include "problems/error.h"

namespace conebench::dem::test {
namespace {

using Eigen::Vector3d;

std::vector<Touch> plane_touches_of(const Piece& piece, const Pose& pose, const Vector3d& at,
                                    const Vector3d& normal, double reach) {
  std::vector<Touch> found;
  plane_touches(piece, pose, at, normal, reach, found);
  return found;
}

TEST(PlaneTouches, TheLeastGapIsThatOfTheSupport) {
  Random random(1);
  for (int k = 0; k < 2000; ++k) {
    const Piece piece = k % 5 == 4 ? Piece(Ball{0.3}) : random.piece(k % 5);
    const Pose pose = at(random.vector(), random.turn());
    const Vector3d point = random.vector(), normal = random.direction();
    const auto touches = plane_touches_of(piece, pose, point, normal, 100.0);
    EXPECT_NEAR(nearest(touches).gap, normal.dot(support(piece, pose, -normal) - point), 1e-12);
    for (const Touch& touch : touches) {
      EXPECT_EQ(touch.normal, normal);
      EXPECT_NEAR(normal.dot(touch.point - point), 0.5 * touch.gap, 1e-12);
      EXPECT_TRUE(holds(piece, pose, touch.point + 0.5 * touch.gap * normal, 1e-12));
    }
  }
}

TEST(PlaneTouches, TheyAreAsManyAsThePieceHasCornersWithinReach) {
  const Vector3d up = Vector3d::UnitZ(), origin = Vector3d::Zero();
  const auto count = [&](const Piece& piece, const Pose& pose, double reach) {
    return plane_touches_of(piece, pose, origin, up, reach).size();
  };
  const auto lying = turned(1.5707963267948966, Vector3d::UnitX());
  EXPECT_EQ(count(Ball{0.5}, at({0, 0, 0.5}), 0.1), 1u);
  EXPECT_EQ(count(Box{{0.5, 0.5, 0.5}}, at({0, 0, 0.5}), 0.1), 4u);
  EXPECT_EQ(count(Box{{0.5, 0.5, 0.5}}, at({0, 0, 0.5}), 1.1), 8u);
  EXPECT_EQ(count(Capsule{0.2, 0.5}, at({0, 0, 0.2}, lying), 0.1), 2u);
  EXPECT_EQ(count(Capsule{0.2, 0.5}, at({0, 0, 0.7}), 0.1), 1u);
  EXPECT_EQ(count(Cylinder{0.2, 0.5}, at({0, 0, 0.5}), 0.1), 4u);
  EXPECT_EQ(count(Cylinder{0.2, 0.5}, at({0, 0, 0.2}, lying), 0.1), 2u);
  EXPECT_EQ(count(Cylinder{0.2, 0.5}, at({0, 0, 0.61}), 0.1), 0u);
}

TEST(PlaneTouches, AStandingCylinderTouchesAtFourPointsOfItsRim) {
  const auto touches = plane_touches_of(Cylinder{0.2, 0.5}, at({1.0, 2.0, 0.5 + 1e-3}),
                                        Vector3d::Zero(), Vector3d::UnitZ(), 0.1);
  for (const double r : {-0.2, 0.2}) {
    EXPECT_TRUE(has(touches, {1.0 + r, 2.0, 5e-4}, Vector3d::UnitZ(), 1e-3));
    EXPECT_TRUE(has(touches, {1.0, 2.0 + r, 5e-4}, Vector3d::UnitZ(), 1e-3));
  }
}

TEST(PlaneTouches, AMeshIsRefused) {
  const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  EXPECT_THROW(plane_touches_of(mesh, {}, Vector3d::Zero(), Vector3d::UnitZ(), 1.0),
               problems::InputError);
}

}  // namespace
}  // namespace conebench::dem::test
