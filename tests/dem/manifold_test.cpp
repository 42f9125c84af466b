#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "narrow_phase_helper.h"

namespace conebench::dem::test {
namespace {

using Eigen::Vector3d;

const Vector3d kUp = Vector3d::UnitZ();
constexpr double kPi = std::numbers::pi;
constexpr double kReach = 1e-2;

const Box kCube{{0.5, 0.5, 0.5}};
const Box kFloor{{5.0, 5.0, 0.5}};  // its top is at 0.5

// A touch on the floor's top.
bool on_floor(const std::vector<Touch>& touches, double x, double y, double gap) {
  return has(touches, {x, y, 0.5 + 0.5 * gap}, kUp, gap);
}

class AtGap : public testing::TestWithParam<double> {};

TEST_P(AtGap, BoxesFaceToFaceTouchAtTheFourCorners) {
  const auto touches =
      touches_of(kCube, at({0, 0, 1.0 + GetParam()}), kFloor, at({0, 0, 0}), kReach);
  ASSERT_EQ(touches.size(), 4u);
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) EXPECT_TRUE(on_floor(touches, x, y, GetParam()));
  }
}

TEST_P(AtGap, EqualBoxesStackedTouchAtTheFourCorners) {
  const auto tilt = Random(1).turn();  // rounding must not add corners
  const auto touches = touches_of(kCube, at(tilt * Vector3d(0, 0, 1.0 + GetParam()), tilt), kCube,
                                  at({0, 0, 0}, tilt), kReach);
  ASSERT_EQ(touches.size(), 4u);
  for (const double x : {-0.5, 0.5}) {
    for (const double y : {-0.5, 0.5}) {
      EXPECT_TRUE(
          has(touches, tilt * Vector3d(x, y, 0.5 + 0.5 * GetParam()), tilt * kUp, GetParam()));
    }
  }
}

TEST_P(AtGap, BoxTurnedByHalfARightAngleOnAnEqualOneTouchesAtEightCorners) {
  const auto touches = touches_of(kCube, at({0, 0, 1.0 + GetParam()}, turned(kPi / 4, kUp)), kCube,
                                  at({0, 0, 0}), kReach);
  ASSERT_EQ(touches.size(), 8u);
  const double cut = std::sqrt(0.5) - 0.5;  // |x| + |y| = sqrt(1/2) meets x = 1/2
  for (const double a : {-0.5, 0.5}) {
    for (const double b : {-cut, cut}) {
      EXPECT_TRUE(on_floor(touches, a, b, GetParam()));
      EXPECT_TRUE(on_floor(touches, b, a, GetParam()));
    }
  }
}

TEST_P(AtGap, BoxesThatShareAPartTouchAtItsCorners) {
  const auto touches =
      touches_of(kCube, at({0.3, -0.6, 1.0 + GetParam()}), kCube, at({0, 0, 0}), kReach);
  ASSERT_EQ(touches.size(), 4u);
  for (const double x : {-0.2, 0.5}) {
    for (const double y : {-0.5, -0.1}) EXPECT_TRUE(on_floor(touches, x, y, GetParam()));
  }
}

TEST_P(AtGap, BoxOnItsEdgeTouchesAtTwoPoints) {
  const auto touches = touches_of(
      kCube, at({0, 0, 0.5 + std::sqrt(0.5) + GetParam()}, turned(kPi / 4, Vector3d::UnitX())),
      kFloor, at({0, 0, 0}), kReach);
  ASSERT_EQ(touches.size(), 2u);
  for (const double x : {-0.5, 0.5}) EXPECT_TRUE(on_floor(touches, x, 0.0, GetParam()));
}

TEST_P(AtGap, CrossedEdgesTouchAtOnePoint) {
  const auto touches =
      touches_of(kCube, at({0, 0, std::sqrt(2.0) + GetParam()}, turned(kPi / 4, Vector3d::UnitX())),
                 kCube, at({0, 0, 0}, turned(kPi / 4, Vector3d::UnitY())), kReach);
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_TRUE(has(touches, {0, 0, std::sqrt(0.5) + 0.5 * GetParam()}, kUp, GetParam()));
}

TEST_P(AtGap, CapsuleLyingOnABoxTouchesAtItsTwoEnds) {
  const auto touches = touches_of(Capsule{0.2, 0.7},
                                  at({0, 0, 0.7 + GetParam()}, turned(kPi / 2, Vector3d::UnitX())),
                                  kFloor, at({0, 0, 0}), kReach);
  ASSERT_EQ(touches.size(), 2u);
  for (const double y : {-0.7, 0.7}) EXPECT_TRUE(on_floor(touches, 0.0, y, GetParam()));
}

TEST_P(AtGap, CapsuleThatOverhangsTouchesAtTheEdgeOfTheBox) {
  const auto touches = touches_of(
      Capsule{0.2, 0.7}, at({0, 0.1, 0.7 + GetParam()}, turned(kPi / 2, Vector3d::UnitX())), kCube,
      at({0, 0, 0}), kReach);
  ASSERT_EQ(touches.size(), 2u);
  for (const double y : {-0.5, 0.5}) EXPECT_TRUE(on_floor(touches, 0.0, y, GetParam()));
}

TEST_P(AtGap, ParallelCapsulesTouchAtTheEndsOfWhatTheyShare) {
  const auto touches = touches_of(Capsule{0.2, 0.7}, at({0.5 + GetParam(), 0, 0.3}),
                                  Capsule{0.3, 0.5}, at({0, 0, 0}), kReach);
  ASSERT_EQ(touches.size(), 2u);
  for (const double z : {-0.4, 0.5}) {
    EXPECT_TRUE(has(touches, {0.3 + 0.5 * GetParam(), 0, z}, Vector3d::UnitX(), GetParam()));
  }
}

TEST_P(AtGap, CrossedCapsulesTouchAtOnePoint) {
  const auto touches =
      touches_of(Capsule{0.2, 0.7}, at({0.5 + GetParam(), 0.1, 0.3}), Capsule{0.3, 0.5},
                 at({0, 0, 0}, turned(1.0, Vector3d::UnitX())), kReach);
  ASSERT_EQ(touches.size(), 1u);
  // The axis (0, -sin 1, cos 1) s meets y = 0.1.
  const double z = -0.1 / std::tan(1.0);
  EXPECT_TRUE(has(touches, {0.3 + 0.5 * GetParam(), 0.1, z}, Vector3d::UnitX(), GetParam()));
}

TEST_P(AtGap, CylinderStandingOnABoxTouchesAtFourPointsOfItsRim) {
  const auto touches = touches_of(Cylinder{0.4, 0.6}, at({0.2, 0.1, 1.1 + GetParam()}), kFloor,
                                  at({0, 0, 0}), kReach);
  ASSERT_EQ(touches.size(), 4u);
  for (const double r : {-0.4, 0.4}) {
    EXPECT_TRUE(on_floor(touches, 0.2 + r, 0.1, GetParam()));
    EXPECT_TRUE(on_floor(touches, 0.2, 0.1 + r, GetParam()));
  }
}

TEST_P(AtGap, CylinderThatOverhangsTouchesWhereItsRimMeetsTheEdge) {
  const auto touches = touches_of(Cylinder{0.4, 0.6}, at({0.3, 0.0, 1.1 + GetParam()}), kCube,
                                  at({0, 0, 0}), kReach);
  ASSERT_EQ(touches.size(), 5u);  // three points of the rim, two of the edge
  EXPECT_TRUE(on_floor(touches, -0.1, 0.0, GetParam()));
  for (const double side : {-1.0, 1.0}) {
    EXPECT_TRUE(on_floor(touches, 0.3, 0.4 * side, GetParam()));
    EXPECT_TRUE(on_floor(touches, 0.5, std::sqrt(0.12) * side, GetParam()));
  }
}

TEST_P(AtGap, CylinderLyingOnABoxTouchesAtTwoPoints) {
  const auto touches = touches_of(
      Cylinder{0.4, 0.6}, at({0, 0.2, 0.9 + GetParam()}, turned(kPi / 2, Vector3d::UnitX())),
      kFloor, at({0, 0, 0}), kReach);
  ASSERT_EQ(touches.size(), 2u);
  for (const double y : {-0.4, 0.8}) EXPECT_TRUE(on_floor(touches, 0.0, y, GetParam()));
}

TEST_P(AtGap, BoxOnACylinderTouchesAtItsCornersWithinTheRim) {
  const Box small{{0.2, 0.1, 0.3}};
  const auto touches =
      touches_of(small, at({0.1, 0, 0.8 + GetParam()}), Cylinder{0.4, 0.5}, at({0, 0, 0}), kReach);
  ASSERT_EQ(touches.size(), 4u);
  for (const double x : {-0.1, 0.3}) {
    for (const double y : {-0.1, 0.1}) EXPECT_TRUE(on_floor(touches, x, y, GetParam()));
  }
}

TEST_P(AtGap, CylindersEndToEndTouchAroundTheLensTheyShare) {
  const auto touches = touches_of(Cylinder{0.4, 0.5}, at({0.5, 0, 1.0 + GetParam()}),
                                  Cylinder{0.3, 0.5}, at({0, 0, 0}), kReach);
  ASSERT_EQ(touches.size(), 4u);
  EXPECT_TRUE(on_floor(touches, 0.1, 0.0, GetParam()));
  EXPECT_TRUE(on_floor(touches, 0.3, 0.0, GetParam()));
  // x^2 + y^2 = 0.09 and (x - 0.5)^2 + y^2 = 0.16.
  const double x = 0.18, y = std::sqrt(0.09 - x * x);
  for (const double side : {-1.0, 1.0}) EXPECT_TRUE(on_floor(touches, x, side * y, GetParam()));
}

TEST_P(AtGap, EqualParallelCylindersTouchAtTheirTwoEnds) {
  const auto tilt = Random(2).turn();
  const auto touches =
      touches_of(Cylinder{0.4, 0.5}, at(tilt * Vector3d(0.8 + GetParam(), 0, 0), tilt),
                 Cylinder{0.4, 0.5}, at({0, 0, 0}, tilt), kReach);
  ASSERT_EQ(touches.size(), 2u);
  for (const double z : {-0.5, 0.5}) {
    EXPECT_TRUE(has(touches, tilt * Vector3d(0.4 + 0.5 * GetParam(), 0, z),
                    tilt * Vector3d::UnitX(), GetParam()));
  }
}

TEST_P(AtGap, CrossedCylindersTouchAtOnePoint) {
  const auto touches =
      touches_of(Cylinder{0.4, 0.7}, at({0.7 + GetParam(), 0, 0}), Cylinder{0.3, 0.9},
                 at({0, 0.2, 0}, turned(kPi / 2, Vector3d::UnitX())), kReach);
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_TRUE(has(touches, {0.3 + 0.5 * GetParam(), 0, 0}, Vector3d::UnitX(), GetParam()));
}

TEST_P(AtGap, HexagonalPrismsTouchAtAllCorners) {
  Hull prism;
  for (int k = 0; k < 12; ++k) {
    prism.points_m.push_back({std::cos(k * kPi / 3), std::sin(k * kPi / 3), k < 6 ? 0.0 : 1.0});
  }
  prism.points_m.push_back({0.1, 0.0, 0.5});  // inside
  prism.points_m.push_back({0.0, 0.0, 1.0});  // inside a face
  const auto on_box =
      touches_of(prism, at({0, 0, 0.5 + GetParam()}), kFloor, at({0, 0, 0}), kReach);
  EXPECT_EQ(on_box.size(), 6u);
  for (int k = 0; k < 6; ++k) {
    EXPECT_TRUE(on_floor(on_box, std::cos(k * kPi / 3), std::sin(k * kPi / 3), GetParam()));
  }
  const auto on_prism = touches_of(prism, at({0, 0, 1.0 + GetParam()}, turned(kPi / 6, kUp)), prism,
                                   at({0, 0, 0}), kReach);
  EXPECT_EQ(on_prism.size(), 12u);
}

INSTANTIATE_TEST_SUITE_P(Gaps, AtGap, testing::Values(1e-4, 1e-9, 0.0, -1e-9, -1e-4));

// Apart only: in overlap the faces next to the edges come free sooner.
TEST(Manifold, ParallelEdgesTouchAtTheEndsOfWhatTheyShare) {
  const auto turn = turned(kPi / 4, Vector3d::UnitX());
  for (const double gap : {1e-3, 1e-6}) {
    const auto touches = touches_of(kCube, at({0.2, 0, std::sqrt(2.0) + gap}, turn), kCube,
                                    at({0, 0, 0}, turn), kReach);
    ASSERT_EQ(touches.size(), 2u);
    for (const double x : {-0.3, 0.5}) {
      EXPECT_TRUE(has(touches, {x, 0, std::sqrt(0.5) + 0.5 * gap}, kUp, gap));
    }
  }
}

TEST(Manifold, ABoxTiltedOverAFloorHasTheGapsOfItsCorners) {
  constexpr double tilt = 1e-3;
  const double rise = std::sin(tilt), low = 0.5 * (std::cos(tilt) + std::sin(tilt));
  const auto touches = touches_of(kCube, at({0, 0, 0.5 + low}, turned(tilt, Vector3d::UnitY())),
                                  kFloor, at({0, 0, 0}), kReach);
  ASSERT_EQ(touches.size(), 4u);
  EXPECT_EQ(std::count_if(touches.begin(), touches.end(),
                          [&](const Touch& t) { return std::abs(t.gap - rise) < 1e-9; }),
            2);
  EXPECT_NEAR(nearest(touches).gap, 0.0, 1e-12);
  EXPECT_EQ(touches_of(kCube, at({0, 0, 0.5 + low}, turned(tilt, Vector3d::UnitY())), kFloor,
                       at({0, 0, 0}), 0.5 * rise)
                .size(),
            2u);
}

TEST(Manifold, NothingIsFoundBeyondTheReach) {
  EXPECT_TRUE(touches_of(kCube, at({0, 0, 1.02}), kFloor, at({0, 0, 0}), kReach).empty());
  EXPECT_EQ(touches_of(kCube, at({0, 0, 1.02}), kFloor, at({0, 0, 0}), 0.03).size(), 4u);
}

}  // namespace
}  // namespace conebench::dem::test
