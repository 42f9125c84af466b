// A layer on a slope flows above its friction angle.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/mpm/engine_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using mpm::Scene;
using mpm::Simulation;

// Acceleration along the slope, in units of g, of the middle of a long thin layer at rest on a
// rough plane. Plane flow of mu = 0.4. Its ends are free and slump at once; so near the friction
// angle what is 30 depths away is still felt (0.003 g at 2 degrees below it, 0 at 4).
double slope_acceleration(double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  Scene scene = open_scene({128, 4});
  scene.gravity_m_s2 = kGravity * Vector3d(std::sin(angle), -std::cos(angle), 0.0);
  scene.walls[2].condition = mpm::Condition::kStick;
  scene.step_s = 4e-3;
  add_block(scene, {4.0, 0.0, 0.0}, {124.0, 2.0, 0.0});
  Simulation simulation(scene, step_solver("auto", 1e-6));
  run(simulation, 25);
  double sum = 0.0, count = 0.0;
  for (std::size_t p = 0; p < simulation.particles().count(); ++p) {
    const Vector3d& x = simulation.particles().position[p];
    if (std::abs(x.x() - 6.4) > 0.5 || x.y() < 0.1) continue;
    sum += simulation.particles().velocity[p].x();
    count += 1.0;
  }
  return sum / count / simulation.time_s() / kGravity;
}

TEST(Slope, FlowsAboveTheFrictionAngleAndStaysBelow) {
  // sin(phi) = mu in plane flow: phi = 23.6 degrees, tan(phi) = mu / sqrt(1 - mu^2).
  const double friction_angle = std::asin(0.4) * 180.0 / std::numbers::pi;
  EXPECT_NEAR(slope_acceleration(friction_angle - 4.0), 0.0, 1e-4);
  EXPECT_NEAR(slope_acceleration(friction_angle - 2.0), 0.0, 5e-3);
  // A layer sheared along the plane has equal normal stresses: it accelerates by
  // g (sin - mu cos).
  const double above = (friction_angle + 2.0) * std::numbers::pi / 180.0;
  EXPECT_NEAR(slope_acceleration(friction_angle + 2.0), std::sin(above) - 0.4 * std::cos(above),
              2e-3);
}

}  // namespace
}  // namespace conebench::test
