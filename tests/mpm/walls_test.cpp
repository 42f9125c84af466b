// Sand against the walls of its grid.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/mpm/engine_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using mpm::Scene;
using mpm::Simulation;

TEST(Walls, FreeOnesLetParticlesOutAndCountThem) {
  Scene scene = open_scene({6, 6});
  scene.gravity_m_s2.setZero();
  mpm::Block& block = add_block(scene, {3.2, 2.2, 0.0}, {5.2, 4.2, 0.0});
  block.velocity_m_s = {5.0, 0.0, 0.0};
  Simulation simulation(scene, step_solver("auto", 1e-6));
  const auto count = static_cast<std::int64_t>(simulation.particles().count());
  const double volume = 0.6 * 0.04;
  std::int64_t some = 0;
  while (simulation.particles().count() > 0 && simulation.time_s() < 0.2) {
    simulation.step();
    const auto left = static_cast<std::int64_t>(simulation.particles().count());
    EXPECT_EQ(simulation.summary().left_particles + left, count);
    double inside = 0.0;
    for (const double part : simulation.particles().volume) inside += part;
    EXPECT_NEAR(simulation.summary().left_volume_m3 + inside, volume, 1e-14);
    for (const Vector3d& x : simulation.particles().position) {
      EXPECT_TRUE(scene.grid.contains(x));
    }
    some += left > 0 && left < count;
  }
  EXPECT_EQ(simulation.summary().left_particles, count);
  EXPECT_GT(some, 3);
  simulation.step();  // an empty grid is no error
  EXPECT_EQ(simulation.summary().last_cones, 0);
}

TEST(Walls, OtherOnesKeepEveryParticle) {
  Scene scene = box_scene({6, 6});
  scene.walls[0] = {mpm::Condition::kFrictional, 0.2};
  scene.walls[1].condition = mpm::Condition::kStick;
  mpm::Block& block = add_block(scene, {3.2, 2.2, 0.0}, {5.2, 5.2, 0.0});
  block.velocity_m_s = {8.0, 3.0, 0.0};
  block.jitter = 1.0;
  Simulation simulation(scene, step_solver("auto", 1e-3));
  const std::size_t count = simulation.particles().count();
  for (int k = 0; k < 100; ++k) {
    simulation.step();
    for (const Vector3d& x : simulation.particles().position) ASSERT_TRUE(scene.grid.contains(x));
  }
  EXPECT_EQ(simulation.particles().count(), count);
}

// The first step of a block that fills its grid: every node is dense, so the law has no choice.
TEST(Walls, FrictionalOneSlowsADenseBlockByItsFriction) {
  const double angle = 0.5;
  for (const double mu : {0.0, 0.2, 0.6, 1.2}) {
    Scene scene = open_scene({3, 2});
    scene.gravity_m_s2 = kGravity * Vector3d(std::sin(angle), -std::cos(angle), 0.0);
    scene.walls[2] = {mpm::Condition::kFrictional, mu};
    scene.material.friction = 0.8;
    scene.material.cohesion_Pa = 1e6;
    add_block(scene, Vector3d::Zero(), {3.0, 2.0, 0.0}).velocity_m_s = {0.5, 0.0, 0.0};
    Simulation simulation(scene, step_solver("auto", 1e-9));
    const double mass = mass_of(simulation);
    simulation.step();
    const double gain = simulation.time_s() * kGravity * std::cos(angle) * (std::tan(angle) - mu);
    EXPECT_NEAR(momentum_of(simulation).x() / mass, 0.5 + gain, 1e-8) << "mu_w " << mu;
  }
}

// A flat block with a cohesion that nothing here overcomes, on a plane of friction mu_w at a slope
// of 0.5; mean velocity after `steps` of 2e-3 s, having started at `speed`.
Vector3d slide(double mu_w, double speed, int steps) {
  Scene scene = open_scene({12, 4});
  scene.gravity_m_s2 = kGravity * Vector3d(std::sin(0.5), -std::cos(0.5), 0.0);
  scene.walls[2] = {mpm::Condition::kFrictional, mu_w};
  scene.material.friction = 0.8;
  scene.material.cohesion_Pa = 1e6;
  add_block(scene, {2.0, 0.0, 0.0}, {8.0, 2.0, 0.0}).velocity_m_s = {speed, 0.0, 0.0};
  Simulation simulation(scene, step_solver("auto", 1e-9));
  const double mass = mass_of(simulation);
  run(simulation, steps);
  return momentum_of(simulation) / mass;
}

// By g (sin - mu cos), but for what the block's under-dense ends sink meanwhile: friction is mu
// times the normal impulse, so that v_x + mu v_y grows by exactly that.
TEST(Walls, BlockSlidesDownAFrictionalOneAtItsAcceleration) {
  for (const double mu : {0.0, 0.2, 0.6}) {
    const Vector3d v = slide(mu, 0.5, 20);
    const double gain = 20 * 2e-3 * kGravity * (std::sin(0.5) - mu * std::cos(0.5));
    EXPECT_NEAR(v.x() + mu * v.y(), 0.5 + gain, 1e-9) << "mu_w " << mu;
    EXPECT_NEAR(v.x(), 0.5 + gain, 5e-3) << "mu_w " << mu;
  }
}

// Slowed by g cos (0.8 - tan 0.5) = 2.2 m/s2 it stops after 0.09 s.
TEST(Walls, FrictionalOneHoldsABlockThatStops) { EXPECT_LT(slide(0.8, 0.2, 100).norm(), 1e-6); }

}  // namespace
}  // namespace conebench::test
