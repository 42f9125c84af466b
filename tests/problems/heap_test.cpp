// Heaps made by hand, whose front, centre and slopes are known.

#include "problems/engine/heap.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <random>

namespace conebench::engine {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kRadius = 0.5;
const Vector3d kUp = Vector3d::UnitZ();

// Grains on a square lattice that lie under a surface z(x, y), its y = 0 plane alone if `flat`.
template <class Surface>
Heap under(const Surface& surface, int reach, bool flat) {
  Heap heap{.grains = {}, .cell_m = 1.0};
  for (int x = -reach; x <= reach; ++x) {
    for (int y = flat ? 0 : -reach; y <= (flat ? 0 : reach); ++y) {
      for (int z = 0; z < surface(x, y); ++z) {
        heap.grains.push_back({.position = Vector3d(x, y, z), .mass = 1.0, .radius = kRadius});
      }
    }
  }
  return heap;
}

double angle_deg(const Heap& heap, const Vector3d& up = kUp) {
  const auto angle = flank_angle(heap, up);
  EXPECT_TRUE(angle.has_value());
  return angle.value_or(NAN) / kDegree;
}

Heap turned(Heap heap, const Eigen::Quaterniond& turn, const Vector3d& shift) {
  for (Grain& grain : heap.grains) grain.position = turn * grain.position + shift;
  return heap;
}

Heap cone(double angle_deg) {
  const double slope = std::tan(angle_deg * kDegree);
  return under([=](int x, int y) { return 24.0 - slope * std::hypot(x, y); }, 70, false);
}

TEST(FlankAngle, OfWedgesIsTheirSlope) {
  for (const double degrees : {12.0, 25.0, 38.0}) {
    const double slope = std::tan(degrees * kDegree);
    const auto wedge = [=](int x, int) { return 40.0 - slope * std::abs(x); };
    EXPECT_NEAR(angle_deg(under(wedge, 250, true)), degrees, 0.5) << degrees;
  }
}

TEST(FlankAngle, AgainstAWallIsThatOfTheOneFlank) {
  const auto heap = [](int x, int) { return x < 0 ? 0.0 : 40.0 - 0.5 * x; };
  EXPECT_NEAR(angle_deg(under(heap, 100, true)), std::atan(0.5) / kDegree, 0.5);
}

TEST(FlankAngle, OfARidgeWithAFlatTopIsThatOfItsFlanks) {
  const auto ridge = [](int x, int) { return 20.0 - 0.6 * std::max(0, std::abs(x) - 15); };
  EXPECT_NEAR(angle_deg(under(ridge, 60, false)), std::atan(0.6) / kDegree, 0.8);
}

TEST(FlankAngle, OfConesIsTheirSlope) {
  for (const double degrees : {20.0, 30.0}) EXPECT_NEAR(angle_deg(cone(degrees)), degrees, 0.7);
}

TEST(FlankAngle, IsTheSameWhereverTheHeapIsAndWhateverIsUp) {
  const Heap heap = cone(25.0);
  const double there = angle_deg(heap);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (int trial = 0; trial < 10; ++trial) {
    const Eigen::Quaterniond turn =
        Eigen::Quaterniond(any(random), any(random), any(random), any(random)).normalized();
    const Vector3d shift = 100.0 * Vector3d(any(random), any(random), any(random));
    EXPECT_NEAR(angle_deg(turned(heap, turn, shift), turn * kUp), there, 0.7);
  }
}

TEST(FlankAngle, IsNotSaidOfWhatHasNoFlanks) {
  const auto layer = [](int, int) { return 2.0; };
  EXPECT_FALSE(flank_angle(under(layer, 20, true), kUp).has_value());
  const auto column = [](int x, int) { return std::abs(x) <= 3 ? 20.0 : 0.0; };
  EXPECT_FALSE(flank_angle(under(column, 20, true), kUp).has_value());
  const Heap one{.grains = {{.position = Vector3d::Zero(), .mass = 1.0, .radius = 1.0}},
                 .cell_m = 1.0};
  EXPECT_FALSE(flank_angle(one, kUp).has_value());
}

// A hundred grains in a row, 1 m apart.
Heap row() {
  Heap heap{.grains = {}, .cell_m = 1.0};
  for (int x = 1; x <= 100; ++x) {
    heap.grains.push_back({.position = Vector3d(x, 0, 7), .mass = 2.0, .radius = 0.5});
  }
  return heap;
}

TEST(Reach, HoldsTheShareOfTheMassThatIsAskedFor) {
  EXPECT_DOUBLE_EQ(reach(row(), kUp, Vector3d::Zero(), 0.99), 99.0);
  EXPECT_DOUBLE_EQ(reach(row(), kUp, Vector3d::Zero(), 0.5), 50.0);
  EXPECT_DOUBLE_EQ(reach(row(), kUp, Vector3d::Zero(), 1.0), 100.0);
}

TEST(Reach, IsHorizontalAndLooksToAllSides) {
  EXPECT_DOUBLE_EQ(reach(row(), kUp, Vector3d(0, 0, -50), 0.99), 99.0);
  EXPECT_DOUBLE_EQ(reach(row(), kUp, Vector3d(101, 0, 0), 1.0), 100.0);
  EXPECT_DOUBLE_EQ(reach(row(), Vector3d::UnitX(), Vector3d::Zero(), 1.0), 7.0);
}

TEST(Reach, OneLightGrainFarAwayDoesNotMoveIt) {
  Heap heap = row();
  heap.grains.push_back({.position = Vector3d(1e4, 0, 0), .mass = 1.0, .radius = 0.5});
  EXPECT_DOUBLE_EQ(reach(heap, kUp, Vector3d::Zero(), 0.985), 99.0);
}

TEST(CentreOfMass, IsWeighedByMass) {
  Heap heap;
  heap.grains = {{.position = Vector3d(1, 2, 3), .mass = 3.0, .radius = 1.0},
                 {.position = Vector3d(5, 2, -1), .mass = 1.0, .radius = 1.0}};
  EXPECT_TRUE(centre_of_mass(heap).isApprox(Vector3d(2, 2, 2)));
}

}  // namespace
}  // namespace conebench::engine
