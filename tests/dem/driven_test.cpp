// Driven bodies and planes, scenes of two dimensions, islands, and how bonds form, weaken and
// break.

#include <gtest/gtest.h>

#include <cmath>

#include "dem/simulation.h"
#include "problems/residual.h"
#include "tests/dem/scene_helper.h"
#include "tests/engine/small_solver.h"

namespace conebench::test {
namespace {

using dem::Simulation;
using Eigen::Vector3d;

constexpr double kGravity = 9.81;

void drive_floor(dem::Scene& scene, const decltype(dem::Motion::kind)& kind) {
  scene.motions.push_back({"floor", kind});
  scene.planes.back().motion = "floor";
}

TEST(Frames, AreOrthonormalRightHandedAndStartWithTheNormal) {
  for (const Vector3d& n : {Vector3d(0, 0, 1), Vector3d(0, 0, -1), Vector3d(1, 2, 3),
                            Vector3d(-1e-9, 1, 0), Vector3d(1, 1, 1)}) {
    dem::Contact contact;
    contact.normal = n.normalized();
    const Eigen::Matrix3d frame = dem::frame_of(contact, 3);
    EXPECT_LT((frame.transpose() * frame - Eigen::Matrix3d::Identity()).norm(), 1e-15 * 10);
    EXPECT_NEAR(frame.determinant(), 1.0, 1e-14);
    EXPECT_EQ(frame.col(0), n.normalized());
  }
  dem::Contact contact;
  contact.normal = Vector3d(0.6, 0.0, -0.8);
  const Eigen::Matrix3d frame = dem::frame_of(contact, 2);
  EXPECT_NEAR(frame.determinant(), 1.0, 1e-14);
  EXPECT_EQ(frame.col(0), contact.normal);
  EXPECT_EQ(frame.col(2), Vector3d::UnitY());
}

TEST(Driven, BeltDragsABallToItsSpeedAsFrictionAllows) {
  dem::Scene scene = small_scene({.friction = 0.2});
  add_floor(scene);
  drive_floor(scene, dem::Slide{{1.0, 0.0, 0.0}, 0.0, 10.0});
  add_body(scene, {0.0, 0.0, 0.05}, 0.05);
  Simulation simulation(scene, small_solver());
  simulation.run(50);
  EXPECT_NEAR(simulation.bodies().velocity[0].x(), 0.2 * kGravity * 0.05, 1e-10);
  // It rolls once v + omega R = 1; then v = 2/7 m/s.
  simulation.run(1000);
  EXPECT_NEAR(simulation.bodies().velocity[0].x(), 2.0 / 7.0, 1e-10);
  EXPECT_NEAR(simulation.bodies().angular_velocity[0].y(), -5.0 / 7.0 / 0.05, 1e-8);
}

TEST(Driven, PistonLiftsAndItsWorkIsBooked) {
  dem::Scene scene = small_scene({.friction = 0.2});
  add_floor(scene);
  drive_floor(scene, dem::Slide{{0.0, 0.0, 0.5}, 0.0, 0.2});
  add_body(scene, {0.0, 0.0, 0.05}, 0.05);
  Simulation simulation(scene, small_solver());
  simulation.run(200);
  const auto& bodies = simulation.bodies();
  EXPECT_NEAR(bodies.position[0].z(), 0.15, 1e-12);
  const double weight = bodies.mass[0] * kGravity;
  // The piston lifts the ball by 0.1 m and, in its first step, brings it to 0.5 m/s: of the work
  // of that impulse, m v^2, half becomes motion and half is lost.
  const double lifted = weight * 0.1, moving = 0.5 * bodies.mass[0] * 0.25;
  const dem::EnergyLedger& energy = simulation.energy();
  EXPECT_NEAR(energy.potential_J + energy.kinetic_J - energy.initial_J, lifted + moving, 1e-12);
  EXPECT_NEAR(energy.driven_J, lifted + 2.0 * moving, 1e-12);
  EXPECT_LT(energy.relative_closure(), 1e-12);
  simulation.run(700);  // it stops: the ball is thrown up and falls back
  EXPECT_NEAR(bodies.position[0].z(), 0.15, 1e-9);
}

TEST(Driven, TurntableCarriesABoxAroundUntilItSlips) {
  const double radius = 0.3, friction = 0.4;
  const double critical = std::sqrt(friction * kGravity / radius);
  for (const double share : {0.98, 1.02}) {
    dem::Scene scene = small_scene({.friction = friction});
    add_floor(scene);
    drive_floor(scene, dem::Turn{Vector3d::Zero(), Vector3d::UnitZ(), share * critical, 0.0, 99.0});
    add_shape(scene, "box", dem::Box{{0.02, 0.02, 0.005}});
    dem::Body& body = add_body(scene, {radius, 0.0, 0.005}, "box");
    body.velocity_m_s = {0.0, share * critical * radius, 0.0};
    body.angular_velocity_rad_s = {0.0, 0.0, share * critical};
    Simulation simulation(scene, small_solver(1e-12));
    simulation.run(1000);
    const double now = simulation.bodies().position[0].head<2>().norm();
    // The circle is a polygon of h omega: its radius grows by a share of h omega^2 t / 2 = 0.7 %.
    if (share < 1.0) {
      EXPECT_NEAR(now, radius, 0.01 * radius);
    } else {
      EXPECT_GT(now, 1.1 * radius);
    }
  }
}

TEST(TwoDimensions, BallRollsDownAsInThree) {
  const auto run = [](int dimension) {
    dem::Scene scene = small_scene({.friction = 0.3});
    scene.dimension = dimension;
    dem::Plane plane;
    plane.normal = {std::sin(0.5), 0.0, std::cos(0.5)};
    plane.material = "grain";
    scene.planes.push_back(plane);
    add_body(scene, 0.1 * plane.normal, 0.1);
    Simulation simulation(scene, small_solver());
    simulation.add_observer([&](const dem::StepView& view) {
      EXPECT_EQ(view.problem->rows(), dimension);
      EXPECT_EQ(view.problem->dofs(), dimension == 2 ? 3 : 6);
    });
    simulation.run(200);
    return simulation.bodies().velocity[0];
  };
  EXPECT_LT((run(2) - run(3)).norm(), 1e-11);
  EXPECT_GT(run(2).x(), 0.3);
}

TEST(TwoDimensions, NothingLeavesThePlane) {
  dem::Scene scene = small_scene({.friction = 0.4});
  scene.dimension = 2;
  add_floor(scene);
  dem::Column column;
  column.base_m = {0.0, 0.0, 0.01};
  column.width_m = 0.2;
  column.height_m = 0.2;
  column.smallest_radius_m = 0.01;
  column.largest_radius_m = 0.02;
  column.material = "grain";
  scene.columns.push_back(column);
  add_shape(scene, "box", dem::Box{{0.03, 0.03, 0.02}});
  add_body(scene, {0.0, 0.0, 0.3}, "box").angular_velocity_rad_s = {0.0, 2.0, 0.0};
  Simulation simulation(scene, small_solver(1e-6));
  simulation.run(400);
  EXPECT_EQ(simulation.bodies().count(), 1 + 5 * 5);
  EXPECT_GT(simulation.summary().most_cones, 20);
  for (std::size_t i = 0; i < 26; ++i) {
    EXPECT_EQ(simulation.bodies().position[i].y(), 0.0);
    EXPECT_EQ(simulation.bodies().angular_velocity[i].x(), 0.0);
    EXPECT_GT(simulation.bodies().position[i].z(), 0.005);
  }
  EXPECT_LT(simulation.energy().relative_closure(), 1e-12);
}

TEST(Islands, AreSolvedOneByOneAndTogetherMakeTheStep) {
  dem::Scene scene = small_scene({.friction = 0.5});
  add_floor(scene);
  for (const double x : {0.0, 1.0}) {
    for (int i = 0; i < 3; ++i) add_body(scene, {x, 0.0, 0.02 * (2 * i + 1)}, 0.02);
  }
  std::vector<int> sizes;
  const engine::StepSolver inner = small_solver();
  Simulation simulation(scene, [&](const auto& standard, const auto& guess) {
    sizes.push_back(standard.cone_count());
    return inner(standard, guess);
  });
  simulation.add_observer([](const dem::StepView& view) {
    EXPECT_EQ(view.problem->cone_count(), 6);
    EXPECT_TRUE(view.answer->converged);
    EXPECT_LT(problems::evaluate_eta(*view.standard, view.answer->r), 1e-12);
  });
  simulation.run(2);
  EXPECT_EQ(sizes, (std::vector<int>{3, 3, 3, 3}));
}

TEST(Islands, OneThatFailsMakesTheStepFailAndTheOthersStand) {
  dem::Scene scene = small_scene({.friction = 0.5});
  add_floor(scene);
  add_body(scene, {0.0, 0.0, 0.02}, 0.02);
  add_body(scene, {1.0, 0.0, 0.02}, 0.02);
  int calls = 0;
  const engine::StepSolver inner = small_solver();
  Simulation simulation(scene, [&](const auto& standard, const auto& guess) {
    engine::StepAnswer answer = inner(standard, guess);
    if (++calls == 1) {
      answer.converged = false;
      answer.status = "time_limit";
    }
    return answer;
  });
  simulation.add_observer([](const dem::StepView& view) {
    EXPECT_FALSE(view.answer->converged);
    EXPECT_EQ(view.answer->status, "time_limit");
  });
  simulation.run(1);
  EXPECT_EQ(simulation.summary().unconverged_steps, 1);
  EXPECT_NEAR(simulation.bodies().velocity[1].z(), 0.0, 1e-13);
}

// A ball that hangs from a ceiling, which is pulled up at 1 mm/s; the ball is held by its weight
// alone, so the bond's force is its weight until it is open.
dem::Scene hanging(const dem::PairLaw& law) {
  dem::Scene scene = small_scene(law);
  dem::Plane ceiling;
  ceiling.normal = -Vector3d::UnitZ();
  ceiling.material = "grain";
  scene.planes.push_back(ceiling);
  add_body(scene, {0.0, 0.0, -0.02}, 0.02);
  return scene;
}

TEST(Bonds, StrengthDecaysWithOpening) {
  const dem::PairLaw law{.friction = 0.5,
                         .tensile_force_N = 3.0,
                         .rupture_distance_m = 1e-3,
                         .decay = dem::Decay::kLinear};
  EXPECT_EQ(law.strength_N(-1e-5), 3.0);
  EXPECT_DOUBLE_EQ(law.strength_N(2.5e-4), 2.25);
  EXPECT_EQ(law.strength_N(1e-3), 0.0);
  // Thrown down against bonds of the same strength, the decaying one is left the sooner.
  const auto speed_after = [](dem::Decay decay) {
    dem::Scene scene = hanging(
        {.friction = 0.5, .tensile_force_N = 3.0, .rupture_distance_m = 1e-3, .decay = decay});
    scene.step_s = 1e-5;
    scene.bodies[0].velocity_m_s = {0.0, 0.0, -0.3};
    Simulation simulation(scene, small_solver());
    simulation.run(1000);
    EXPECT_EQ(simulation.summary().last_bonds, 0);
    const double fall = 0.5 * simulation.bodies().mass[0] * 0.09 + simulation.energy().bond_J;
    return fall;
  };
  // Work of the bond: F d, or F d / 2, to the order of the step.
  EXPECT_NEAR(speed_after(dem::Decay::kNone) - speed_after(dem::Decay::kLinear), -1.5e-3, 5e-5);
}

TEST(Bonds, ThatFormOnlyAtFirstAreBrokenForGood) {
  for (const bool reversible : {true, false}) {
    dem::PairLaw law{.friction = 0.5, .tensile_force_N = 1e-3, .rupture_distance_m = 1e-4};
    if (!reversible) law.bonds_form_until_s = 1e-3;
    dem::Scene scene = small_scene(law);
    add_floor(scene);
    add_body(scene, {0.0, 0.0, 0.02}, 0.02).velocity_m_s = {0.0, 0.0, 0.1};
    Simulation simulation(scene, small_solver());
    simulation.run(1);
    EXPECT_EQ(simulation.summary().last_bonds, 1);
    simulation.run(110);
    EXPECT_NEAR(simulation.bodies().velocity[0].norm(), 0.0, 1e-12);
    EXPECT_EQ(simulation.summary().last_bonds, reversible ? 1 : 0);
  }
}

}  // namespace
}  // namespace conebench::test
