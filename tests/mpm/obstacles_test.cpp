// Sand against rigid bodies and barriers.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/mpm/engine_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using mpm::Scene;
using mpm::Simulation;

Scene with_ball(int dim) {
  Scene scene = dim == 2 ? box_scene({14, 12}) : box_scene({8, 6, 7});
  scene.walls[static_cast<std::size_t>(2 * dim - 2)].condition = mpm::Condition::kSlip;
  mpm::Body ball;
  ball.motion = mpm::Motion::kFree;
  ball.radius_m = dim == 2 ? 0.15 : 0.12;
  ball.density_kg_m3 = 3000.0;
  ball.friction = 0.5;
  scene.bodies.push_back(ball);
  return scene;
}

TEST(Bodies, BallAndFlyingSandKeepTheirMomentum) {
  for (const int dim : {2, 3}) {
    Scene scene = with_ball(dim);
    scene.gravity_m_s2.setZero();
    for (mpm::Wall& wall : scene.walls) wall.condition = mpm::Condition::kFree;
    scene.bodies[0].centre_m = flat(dim, {0.22, 0.3, 0.35});
    scene.bodies[0].velocity_m_s = {4.0, 0.0, 0.0};
    scene.bodies[0].angular_velocity_rad_s = {0.0, 0.0, 5.0};
    const Vector3d low(4.0, 1.6, dim == 2 ? 0.0 : 2.2);
    add_block(scene, low, low + Vector3d(3.0, 3.0, dim == 2 ? 0.0 : 3.0));
    Simulation simulation(scene, step_solver("gs", 1e-4));
    const Vector3d start = momentum_of(simulation);
    const double speed = simulation.bodies()[0].velocity.norm();
    run(simulation, 30);
    EXPECT_LT((momentum_of(simulation) - start).norm(), 1e-12 * start.norm()) << dim << "D";
    EXPECT_LT(simulation.bodies()[0].velocity.norm(), 0.9 * speed) << "they did not meet";
    EXPECT_EQ(simulation.summary().left_particles, 0);
  }
}

// The floor and the sides are smooth: only gravity and the floor change the momentum upwards, and
// nothing along the floor does until something meets a side.
TEST(Bodies, BallOnABedChangesMomentumByGravityAndTheFloorOnly) {
  Scene scene = with_ball(2);
  scene.bodies[0].centre_m = {0.7, 0.75, 0.0};
  scene.bodies[0].velocity_m_s = {0.5, -3.0, 0.0};
  add_block(scene, {3.0, 0.0, 0.0}, {11.0, 5.0, 0.0});
  Simulation simulation(scene, step_solver("auto", 1e-6));
  const double mass = mass_of(simulation);
  const double along = momentum_of(simulation).x();
  double upwards = momentum_of(simulation).y();
  bool met = false;
  for (int k = 0; k < 60; ++k) {
    const double before_s = simulation.time_s();
    simulation.step();
    const double floor =
        momentum_of(simulation).y() - upwards + mass * kGravity * (simulation.time_s() - before_s);
    EXPECT_GE(floor, -1e-6 * mass) << "the floor pulls";
    upwards = momentum_of(simulation).y();
    EXPECT_NEAR(momentum_of(simulation).x(), along, 1e-12 * mass);
    const double free_fall = -3.0 - kGravity * simulation.time_s();
    met |= simulation.bodies()[0].velocity.y() > free_fall + 0.5;
  }
  EXPECT_TRUE(met);
}

TEST(Bodies, BallStopsAtAWall) {
  Scene scene = with_ball(2);
  scene.bodies[0].centre_m = {0.7, 0.4, 0.0};
  scene.bodies[0].velocity_m_s = {0.0, -1.0, 0.0};
  add_block(scene, {0.0, 0.0, 0.0}, {1.0, 1.0, 0.0});
  Simulation simulation(scene, step_solver("auto", 1e-10));
  run(simulation, 200);
  EXPECT_NEAR(simulation.bodies()[0].centre_m.y(), 0.15, 1e-8);
  EXPECT_NEAR(simulation.bodies()[0].velocity.norm(), 0.0, 1e-8);
}

TEST(Bodies, DrivenOnesMoveAsTheyAreTold) {
  Scene scene = with_ball(2);
  scene.bodies[0].motion = mpm::Motion::kDriven;
  scene.bodies[0].density_kg_m3 = 0.0;
  scene.bodies[0].centre_m = {0.3, 0.25, 0.0};
  scene.bodies[0].velocity_m_s = {1.0, 0.0, 0.0};
  add_block(scene, {5.0, 0.0, 0.0}, {9.0, 4.0, 0.0});
  Simulation simulation(scene, step_solver("auto", 1e-5));
  run(simulation, 100);
  EXPECT_NEAR(simulation.bodies()[0].centre_m.x(), 0.3 + simulation.time_s(), 1e-12);
  EXPECT_EQ(simulation.bodies()[0].velocity, Vector3d(1.0, 0.0, 0.0));
  EXPECT_GT(momentum_of(simulation).x(), 0.0) << "it does not push the sand";
}

Scene behind_a_door() {
  Scene scene = box_scene({10, 6});
  add_block(scene, Vector3d::Zero(), {4.0, 4.0, 0.0});
  mpm::Barrier door;
  door.axis = 0;
  door.position_m = 0.4;
  door.low_m = {0.0, 0.0, 0.0};
  door.high_m = {0.0, 0.6, 0.0};
  door.opens_s = 0.1;
  scene.barriers.push_back(door);
  return scene;
}

TEST(Barriers, HoldAndThenLetGo) {
  for (const mpm::Condition condition : {mpm::Condition::kSlip, mpm::Condition::kStick}) {
    Scene scene = behind_a_door();
    scene.barriers[0].condition = condition;
    Simulation simulation(scene, step_solver("auto", 1e-8));
    while (simulation.time_s() < 0.1) {
      simulation.step();
      ASSERT_LT(simulation.state().front_m, 0.4);
    }
    EXPECT_LT(simulation.state().fastest_m_s, 1e-5);
    run(simulation, 150);
    EXPECT_GT(simulation.state().front_m, 0.5);
  }
}

TEST(Barriers, ThatRiseOpenFromBelow) {
  Scene scene = behind_a_door();
  scene.barriers[0].opening_m_s = 2.0;
  Simulation simulation(scene, step_solver("auto", 1e-6));
  while (simulation.time_s() < 0.4) {
    simulation.step();
    const double edge = std::max(0.0, 2.0 * (simulation.time_s() - 0.1));
    for (const Vector3d& x : simulation.particles().position) {
      if (x.x() <= 0.4) continue;
      EXPECT_LT(x.y(), edge + 0.1) << "nodes hold up to one cell below the edge";
    }
  }
  EXPECT_GT(simulation.state().front_m, 0.45);
}

}  // namespace
}  // namespace conebench::test
