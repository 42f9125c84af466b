// A silo empties at a rate that the height of the filling has no part in, if what flows is sand.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/mpm/engine_helper.h"

namespace conebench::test {
namespace {

using mpm::Barrier;
using mpm::Condition;
using mpm::Scene;
using mpm::Simulation;

constexpr double kWidth = 1.0, kShelf = 0.2, kFilling = 3.0;  // [m]

// A flat floor with an outlet of 0.4 m over an open bottom, between walls of half the friction.
Scene silo(double friction) {
  Scene scene = box_scene({10, 33});
  scene.step_s = 8e-3;
  scene.material.friction = friction;
  scene.walls[2].condition = Condition::kFree;
  for (int side : {0, 1}) {
    scene.walls[static_cast<std::size_t>(side)] = {Condition::kFrictional, 0.5 * friction};
    Barrier shelf{.axis = 1, .position_m = kShelf, .condition = Condition::kStick};
    shelf.low_m = {side == 0 ? 0.0 : 0.7, kShelf, 0.0};
    shelf.high_m = {side == 0 ? 0.3 : kWidth, kShelf, 0.0};
    scene.barriers.push_back(shelf);
  }
  add_block(scene, {0.0, 2.0, 0.0}, {10.0, 32.0, 0.0});
  return scene;
}

// Mean height of what is left above the shelf against time.
struct Emptying {
  std::vector<double> times_s, heights_m;

  explicit Emptying(double friction) {
    Simulation simulation(silo(friction), step_solver("auto", 1e-3));
    const auto above = [&] {
      return static_cast<double>(
          std::ranges::count_if(simulation.particles().position,
                                [](const Eigen::Vector3d& x) { return x.y() > kShelf; }));
    };
    const double all = above();
    do {
      simulation.step();
      times_s.push_back(simulation.time_s());
      heights_m.push_back(kFilling * above() / all);
    } while (heights_m.back() > 0.7 && simulation.time_s() < 8.0);
  }

  // Fall of the mean height a second [m/s] between two heights, by least squares.
  double rate(double from, double to) const {
    double n = 0.0, t = 0.0, h = 0.0, tt = 0.0, th = 0.0;
    for (std::size_t k = 0; k < times_s.size(); ++k) {
      if (heights_m[k] > from || heights_m[k] < to) continue;
      n += 1.0;
      t += times_s[k];
      h += heights_m[k];
      tt += times_s[k] * times_s[k];
      th += times_s[k] * heights_m[k];
    }
    return -(n * th - t * h) / (n * tt - t * t);
  }
};

TEST(Silo, OfSandEmptiesAtTheSameRateWhateverItsFillingAndOfALiquidDoesNot) {
  const Emptying sand(0.4), liquid(0.0);
  const double of_sand = sand.rate(2.4, 1.9) / sand.rate(1.2, 0.7);
  EXPECT_NEAR(of_sand, 1.0, 0.15);
  // Torricelli, in the middle of either span.
  const double of_liquid = liquid.rate(2.4, 1.9) / liquid.rate(1.2, 0.7);
  EXPECT_NEAR(of_liquid, std::sqrt(2.15 / 0.95), 0.1);
}

}  // namespace
}  // namespace conebench::test
