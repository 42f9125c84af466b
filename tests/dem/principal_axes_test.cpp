#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "dem/shape.h"
#include "tests/dem/shape_helper.h"

namespace conebench::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d with_moments(const Vector3d& moments, const Eigen::Quaterniond& turn) {
  const Matrix3d axes = turn.toRotationMatrix();
  return axes * moments.asDiagonal() * axes.transpose();
}

Matrix3d about(const Vector3d& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis).toRotationMatrix();
}

void expect_diagonal(const Matrix3d& inertia, const dem::PrincipalAxes& principal) {
  EXPECT_LT((principal.axes.transpose() * principal.axes - Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_GT(principal.axes.determinant(), 0.0);
  const Matrix3d back =
      principal.axes * principal.moments.asDiagonal() * principal.axes.transpose();
  EXPECT_LT((back - inertia).norm(), 1e-14 * inertia.norm());
}

TEST(PrincipalAxes, OfADiagonalTensorAreTheCoordinateAxesInTheirOrder) {
  for (const Vector3d& moments :
       {Vector3d(3, 1, 2), Vector3d(1, 2, 3), Vector3d(2, 3, 1), Vector3d(2, 2, 1),
        Vector3d(1, 2, 2), Vector3d(2, 1, 2), Vector3d(5, 5, 5), Vector3d(0, 0, 0)}) {
    const dem::PrincipalAxes principal = dem::principal_axes(moments.asDiagonal());
    EXPECT_EQ(principal.axes, Matrix3d::Identity()) << moments.transpose();
    EXPECT_EQ(principal.moments, moments);
  }
}

TEST(PrincipalAxes, OfAnAlignedBoxAreIdentity) {
  const dem::Box box{{0.9, 0.3, 0.5}};
  const Matrix3d inertia = dem::mass_properties(box).inertia_m5;
  const dem::PrincipalAxes principal = dem::principal_axes(inertia);
  EXPECT_EQ(principal.axes, Matrix3d::Identity());
  EXPECT_EQ(principal.moments, inertia.diagonal());
}

// The hull's sums leave rounding beside the diagonal.
TEST(PrincipalAxes, OfTheHullOfATurnedCubeAreIdentity) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const dem::Hull cube{moved(grid({1.0, 1.0, 1.0}, 2), Draw(seed).pose())};
    EXPECT_EQ(dem::principal_axes(dem::mass_properties(cube).inertia_m5).axes,
              Matrix3d::Identity());
  }
}

TEST(PrincipalAxes, FollowASmallTurn) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    Draw draw(seed);
    const Matrix3d turn = about(draw.direction(), 0.3 * draw.uniform());
    const Vector3d moments(3.0, 1.0, 2.0);
    const dem::PrincipalAxes principal =
        dem::principal_axes(turn * moments.asDiagonal() * turn.transpose());
    EXPECT_LT((principal.axes - turn).norm(), 1e-13) << "seed " << seed;
    EXPECT_LT((principal.moments - moments).norm(), 1e-13);
  }
}

// The other frames along the same axes come by quarter turns about them.
TEST(PrincipalAxes, OfDistinctMomentsAreTheNearestToIdentity) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    Draw draw(seed);
    const Matrix3d inertia = with_moments({3.0, 1.0, 2.0}, draw.turn());
    const dem::PrincipalAxes principal = dem::principal_axes(inertia);
    SCOPED_TRACE(seed);
    expect_diagonal(inertia, principal);
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        for (int c = 0; c < 4; ++c) {
          const double quarter = std::numbers::pi / 2.0;
          const Matrix3d other = principal.axes * about(Vector3d::UnitX(), a * quarter) *
                                 about(Vector3d::UnitY(), b * quarter) *
                                 about(Vector3d::UnitZ(), c * quarter);
          EXPECT_LE(other.trace(), principal.axes.trace() + 1e-8);
        }
      }
    }
  }
}

TEST(PrincipalAxes, OfTwoEqualMomentsAreTheNearestToIdentity) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    Draw draw(seed);
    const Eigen::Quaterniond turn = draw.turn();
    const Vector3d moments = seed % 2 == 0 ? Vector3d(2, 2, 1) : Vector3d(1, 1, 2);
    const Matrix3d inertia = with_moments(moments, turn);
    const dem::PrincipalAxes principal = dem::principal_axes(inertia);
    SCOPED_TRACE(seed);
    expect_diagonal(inertia, principal);
    const Vector3d single = turn * Vector3d::UnitZ();
    for (int k = 0; k < 360; ++k) {
      const Matrix3d other = about(single, k * std::numbers::pi / 180.0) * principal.axes;
      EXPECT_LE(other.trace(), principal.axes.trace() + 1e-8);
    }
  }
}

// Two frames are as near as each other, or all but for rounding: which is taken does not depend on
// the rounding.
TEST(PrincipalAxes, AreTheSameForAnInertiaThatDiffersByRounding) {
  const std::array<Eigen::Quaterniond, 3> halfway = {
      Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 4.0, Vector3d::UnitZ())),
      Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), Vector3d::Ones()),
      Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi / 3.0, Vector3d::Ones().normalized()))};
  for (const Vector3d& moments : {Vector3d(3, 1, 2), Vector3d(2, 2, 1), Vector3d(1, 1, 2)}) {
    for (const Eigen::Quaterniond& turn : halfway) {
      const Matrix3d inertia = with_moments(moments, turn);
      const Matrix3d axes = dem::principal_axes(inertia).axes;
      for (unsigned seed = 0; seed < 50; ++seed) {
        Draw draw(seed);
        Matrix3d noise;
        noise << draw.normal(), draw.normal(), draw.normal();
        const Matrix3d nearly = inertia + 1e-15 * (noise + noise.transpose());
        EXPECT_LT((dem::principal_axes(nearly).axes - axes).norm(), 1e-13);
      }
    }
  }
}

}  // namespace
}  // namespace conebench::test
