// Motions with a closed form. A tolerance without a comment is rounding of some thousand steps.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/simulation.h"
#include "tests/dem/scene_helper.h"
#include "tests/engine/small_solver.h"

namespace conebench::test {
namespace {

using dem::Simulation;
using Eigen::Vector3d;

constexpr double kGravity = 9.81;

// A sphere of radius 0.1 m at rest on the slope z = -x tan(angle), descending along +x.
dem::Scene slope(double angle, double friction) {
  dem::Scene scene = small_scene({.friction = friction});
  dem::Plane plane;
  plane.normal = {std::sin(angle), 0.0, std::cos(angle)};
  plane.material = "grain";
  scene.planes.push_back(plane);
  add_body(scene, 0.1 * plane.normal, 0.1);
  return scene;
}

TEST(Slope, SphereRollsWhenFrictionIsAboveTwoSevenths) {
  const double angle = 0.5;
  Simulation simulation(slope(angle, 2.0 / 7.0 * std::tan(angle) + 0.01), small_solver());
  simulation.run(200);
  const double speed = 0.2 * 5.0 / 7.0 * kGravity * std::sin(angle);
  const Vector3d downhill(std::cos(angle), 0.0, -std::sin(angle));
  // The solver's tolerance, 1e-14 of |q| = 2 m/s a step, over 200 steps.
  EXPECT_NEAR((simulation.bodies().velocity[0] - speed * downhill).norm(), 0.0, 1e-11);
  EXPECT_NEAR(simulation.bodies().angular_velocity[0].y(), speed / 0.1, 1e-10);
}

TEST(Slope, SphereSlidesAndSpinsUpWhenFrictionIsBelow) {
  const double angle = 0.5;
  const double friction = 2.0 / 7.0 * std::tan(angle) - 0.05;
  Simulation simulation(slope(angle, friction), small_solver());
  simulation.run(200);
  const double normal = kGravity * std::cos(angle);
  const double speed = 0.2 * (kGravity * std::sin(angle) - friction * normal);
  EXPECT_NEAR(simulation.bodies().velocity[0].norm(), speed, 1e-10);
  EXPECT_NEAR(simulation.bodies().angular_velocity[0].y(), 0.2 * 2.5 * friction * normal / 0.1,
              1e-10);
}

TEST(Slope, SphereSlidesWithoutTurningWhenThereIsNoFriction) {
  Simulation simulation(slope(0.5, 0.0), small_solver());
  simulation.run(200);
  EXPECT_NEAR(simulation.bodies().velocity[0].norm(), 0.2 * kGravity * std::sin(0.5), 1e-11);
  EXPECT_EQ(simulation.bodies().angular_velocity[0], Vector3d::Zero());
}

// Drops a sphere on the floor; returns the speeds just before and after the first impact and the
// height of the centre at the impact.
struct Impact {
  double before = 0.0, after = 0.0, height_m = 0.0;
};
Impact drop(Simulation& simulation) {
  Impact impact;
  while (impact.after <= 0.0) {
    impact.before = simulation.bodies().velocity[0].z();
    impact.height_m = simulation.bodies().position[0].z();
    simulation.step();
    impact.after = simulation.bodies().velocity[0].z();
  }
  return impact;
}

TEST(Bounce, ReboundSpeedIsRestitutionTimesImpactSpeed) {
  for (const double e : {0.3, 0.8, 1.0}) {
    dem::Scene scene = small_scene({.friction = 0.3, .restitution = e});
    add_floor(scene);
    add_body(scene, {0.0, 0.0, 0.25}, 0.05);
    Simulation simulation(scene, small_solver());
    const Impact impact = drop(simulation);
    EXPECT_NEAR(impact.after, -e * impact.before, 1e-13) << "e = " << e;
    EXPECT_NEAR(impact.before, -std::sqrt(2.0 * kGravity * 0.2), 0.02);
  }
}

TEST(Bounce, ReboundHeightIsTheSchemesOwnClosedForm) {
  dem::Scene scene = small_scene({.friction = 0.3, .restitution = 1.0});
  add_floor(scene);
  add_body(scene, {0.0, 0.0, 0.25}, 0.05);
  Simulation simulation(scene, small_solver());
  const Impact impact = drop(simulation);
  double highest = 0.0;
  for (int k = 0; k < 250; ++k) {
    highest = std::max(highest, simulation.bodies().position[0].z());
    simulation.step();
  }
  // With speed v after the impact, step k moves by h (v - k h g), k = 0, 1, ... while positive.
  const double h = scene.step_s;
  const double v = -impact.before;
  const double n = std::floor(v / (h * kGravity));
  const double expected =
      impact.height_m + h * ((n + 1.0) * v - 0.5 * h * kGravity * n * (n + 1.0));
  EXPECT_NEAR(highest, expected, 1e-10 * expected);
}

TEST(Bounce, WithoutRestitutionTheSphereRestsWithoutPenetration) {
  dem::Scene scene = small_scene({.friction = 0.3});
  add_floor(scene);
  add_body(scene, {0.0, 0.0, 0.25}, 0.05);
  Simulation simulation(scene, small_solver());
  simulation.run(1000);
  EXPECT_NEAR(simulation.bodies().position[0].z(), 0.05, 1e-13);
  EXPECT_NEAR(simulation.bodies().velocity[0].norm(), 0.0, 1e-13);
  EXPECT_LT(simulation.summary().deepest_overlap_m, 1e-13);
}

TEST(Collision, TwoSpheresExchangeMomentumByNewtonsLaw) {
  dem::Scene scene = small_scene({.friction = 0.0, .restitution = 0.6});
  scene.gravity_m_s2.setZero();
  add_body(scene, {0.0, 0.0, 0.0}, 0.02).velocity_m_s = {1.0, 0.0, 0.0};
  add_body(scene, {0.1, 0.0, 0.0}, 0.03);
  Simulation simulation(scene, small_solver());
  simulation.run(100);
  const auto& spheres = simulation.bodies();
  const double m1 = spheres.mass[0], m2 = spheres.mass[1];
  EXPECT_NEAR(spheres.velocity[0].x(), (m1 - 0.6 * m2) / (m1 + m2), 1e-13);
  EXPECT_NEAR(spheres.velocity[1].x(), 1.6 * m1 / (m1 + m2), 1e-13);
}

TEST(Stack, StaysAndCarriesTheWeightAbove) {
  dem::Scene scene = small_scene({.friction = 0.5});
  add_floor(scene);
  for (int i = 0; i < 5; ++i) add_body(scene, {0.0, 0.0, 0.02 * (2 * i + 1)}, 0.02);
  Simulation simulation(scene, small_solver());
  simulation.run(1000);
  const auto& spheres = simulation.bodies();
  for (int i = 0; i < 5; ++i) {
    const Vector3d start(0.0, 0.0, 0.02 * (2 * i + 1));
    EXPECT_LT((spheres.position[static_cast<std::size_t>(i)] - start).norm(), 1e-10) << i;
  }
  for (const dem::Contact& contact : simulation.contacts().contacts()) {
    // The reaction pushes `body`, the lower one of two spheres, down; the floor pushes up.
    const int above = simulation.bodies().is_plane(contact.other) ? 5 : 4 - contact.body;
    EXPECT_NEAR(contact.reaction.norm() / scene.step_s, above * spheres.mass[0] * kGravity, 1e-9);
    EXPECT_GT(contact.reaction.z() * (simulation.bodies().is_plane(contact.other) ? 1.0 : -1.0),
              0.0);
  }
}

// A sphere that hangs from a ceiling with a bond of `strength` times its weight.
Simulation hanging(double strength, bool from_sphere) {
  const double weight = 4.0 / 3.0 * std::numbers::pi * 8e-6 * 2500.0 * kGravity;
  dem::Scene scene = small_scene(
      {.friction = 0.5, .tensile_force_N = strength * weight, .rupture_distance_m = 1e-6});
  if (from_sphere) {
    add_body(scene, {0.0, 0.0, 0.03}, 0.03).fixed = true;
  } else {
    dem::Plane ceiling;
    ceiling.normal = -Vector3d::UnitZ();
    ceiling.material = "grain";
    scene.planes.push_back(ceiling);
  }
  add_body(scene, {0.0, 0.0, -0.02}, 0.02);
  return Simulation(scene, small_solver());
}

Vector3d hanging_ball(const Simulation& simulation) {
  return simulation.bodies().position[static_cast<std::size_t>(simulation.bodies().count()) - 1];
}

TEST(Cohesion, BondHoldsToExactlyItsForce) {
  for (const bool from_sphere : {false, true}) {
    Simulation holds = hanging(1.0 + 1e-9, from_sphere);
    holds.run(2000);
    EXPECT_NEAR(hanging_ball(holds).z(), -0.02, 1e-12);
    EXPECT_EQ(holds.summary().last_bonds, 1);
    // Overloaded by 1e-6 of g it opens by 1e-6 m in 0.45 s, breaks, and falls freely.
    Simulation falls = hanging(1.0 - 1e-6, from_sphere);
    falls.run(2000);
    EXPECT_LT(hanging_ball(falls).z(), -5.0);
    EXPECT_EQ(falls.summary().last_bonds, 0);
  }
}

TEST(Cohesion, GrainsDoNotAttractAtADistance) {
  dem::Scene scene =
      small_scene({.friction = 0.5, .tensile_force_N = 10.0, .rupture_distance_m = 1e-3});
  scene.gravity_m_s2.setZero();
  add_body(scene, {0.0, 0.0, 0.0}, 0.02);
  add_body(scene, {0.0405, 0.0, 0.0}, 0.02);
  Simulation simulation(scene, small_solver());
  simulation.run(50);
  EXPECT_EQ(simulation.bodies().velocity[0], Vector3d::Zero());
  EXPECT_EQ(simulation.summary().last_bonds, 0);
}

TEST(Cohesion, BrokenBondFormsAgainOnContact) {
  dem::Scene scene =
      small_scene({.friction = 0.5, .tensile_force_N = 1e-3, .rupture_distance_m = 1e-4});
  add_floor(scene);
  // Thrown up at 0.1 m/s against a bond that cannot stop it; back on the floor after 0.02 s.
  add_body(scene, {0.0, 0.0, 0.02}, 0.02).velocity_m_s = {0.0, 0.0, 0.1};
  Simulation simulation(scene, small_solver());
  simulation.run(1);
  EXPECT_EQ(simulation.summary().last_bonds, 1);
  simulation.run(10);
  EXPECT_EQ(simulation.summary().last_bonds, 0);
  simulation.run(100);
  EXPECT_EQ(simulation.summary().last_bonds, 1);
  EXPECT_NEAR(simulation.bodies().velocity[0].norm(), 0.0, 1e-12);
}

}  // namespace
}  // namespace conebench::test
