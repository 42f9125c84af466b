// What is measured of runs whose motion is known in closed form.

#include "harness/observables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace conebench::harness {
namespace {

constexpr double kGravity = 9.81;

// A built-in scene, with other values, after some steps.
Observed after(const std::string& scene, const std::vector<std::string>& overrides, int steps) {
  const auto engine = make_engine(engine::with_overrides(find_scene(scene), overrides), {});
  const Watch watch(*engine);
  for (int k = 0; k < steps; ++k) engine->step();
  return watch.observed();
}

double at(const Observed& values, Observable what) {
  return values[static_cast<std::size_t>(what)];
}

TEST(Observables, AreEachAtThePlaceOfItsNumber) {
  for (std::size_t k = 0; k < kObservables; ++k) {
    EXPECT_EQ(static_cast<std::size_t>(observables()[k].what), k);
  }
}

// Positions move with the new velocity: after n steps z - z_0 = -g h^2 n (n + 1) / 2.
TEST(Observables, OfABallInFreeFallAreThoseOfTheScheme) {
  const int n = 50;
  const double h = 1e-3, mass = 7800.0 * 4.0 / 3.0 * std::numbers::pi * std::pow(0.02, 3);
  const Observed fall = after("bouncing-sphere", {}, n);
  EXPECT_NEAR(at(fall, Observable::kCentreHeight), 0.22 - kGravity * h * h * n * (n + 1) / 2.0,
              1e-14);
  EXPECT_NEAR(at(fall, Observable::kEnergyChange), -0.5 * mass * std::pow(kGravity * h, 2) * n,
              1e-14);
  EXPECT_EQ(at(fall, Observable::kEnergyDrift), 0.0);
  EXPECT_EQ(at(fall, Observable::kFront), 0.0);
  EXPECT_EQ(at(fall, Observable::kCentreShift), 0.0);
  EXPECT_EQ(at(fall, Observable::kUnconverged), 0.0);
  EXPECT_TRUE(std::isnan(at(fall, Observable::kAngle)));
}

// A ball rolls down 30 degrees at 5/7 g sin(30).
TEST(Observables, OfABallThatRollsAreItsWayAndNoDrift) {
  const int n = 200;
  const double h = 1e-3, angle = std::numbers::pi / 6.0;
  const Observed roll = after("sphere-on-slope", {}, n);
  const double way = 5.0 / 7.0 * kGravity * std::sin(angle) * h * h * n * (n + 1) / 2.0;
  EXPECT_NEAR(at(roll, Observable::kCentreShift), way * std::cos(angle), 1e-3 * way);
  EXPECT_DOUBLE_EQ(at(roll, Observable::kFront), at(roll, Observable::kCentreShift));
  EXPECT_LT(std::abs(at(roll, Observable::kEnergyDrift)), 1e-6);
  EXPECT_LT(at(roll, Observable::kPenetration), 1e-3);
}

// Sand that is already as dense as it can be rests on its floor.
TEST(Observables, OfABedAtRestAreItsShapeAndNothingElse) {
  const Observed bed = after("sand-bed", {"solver.tol=1e-8"}, 5);
  EXPECT_NEAR(at(bed, Observable::kCentreHeight), 0.2, 1e-6);
  EXPECT_NEAR(at(bed, Observable::kCentreShift), 0.0, 1e-6);
  EXPECT_NEAR(at(bed, Observable::kPenetration), 0.0, 1e-4);
  EXPECT_TRUE(std::isnan(at(bed, Observable::kAngle)));
  EXPECT_GT(at(bed, Observable::kIterations), 0.0);
}

TEST(Observables, LooserSolvesDriftMore) {
  const std::vector<std::string> small = {"grid.cells=[16,4]", "grid.size_m=[4,1]",
                                          "solver.name=gs"};
  std::vector<std::string> loose = small, tight = small;
  loose.push_back("solver.tol=1e-1");
  tight.push_back("solver.tol=1e-7");
  EXPECT_GT(std::abs(at(after("sand-column", loose, 30), Observable::kEnergyDrift)),
            100.0 * std::abs(at(after("sand-column", tight, 30), Observable::kEnergyDrift)));
}

}  // namespace
}  // namespace conebench::harness
