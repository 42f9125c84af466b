// What holds for any motion: conservation, the ledger, signs, warm starts, determinism.

#include "dem/simulation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "dem/export.h"
#include "problems/residual.h"
#include "tests/dem/scene_helper.h"
#include "tests/engine/scene_text.h"
#include "tests/engine/small_solver.h"

namespace conebench::test {
namespace {

using dem::Simulation;
using Eigen::Vector3d;

// A cloud of 27 spheres thrown at each other.
dem::Scene cloud(const dem::PairLaw& law) {
  dem::Scene scene = small_scene(law);
  dem::Column column;
  column.base_m = {0.0, 0.0, 0.05};
  column.width_m = 0.12;
  column.height_m = 0.12;
  column.smallest_radius_m = 0.01;
  column.largest_radius_m = 0.02;
  column.material = "grain";
  scene.columns.push_back(column);
  add_body(scene, {-0.3, 0.01, 0.11}, 0.03).velocity_m_s = {3.0, 0.0, 0.0};
  return scene;
}

Vector3d momentum(const dem::Bodies& spheres) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t i = 0; i < spheres.mass.size(); ++i) {
    sum += spheres.mass[i] * spheres.velocity[i];
  }
  return sum;
}

TEST(Conservation, MomentumIsKeptInFlightAndCollisions) {
  for (const double e : {0.0, 0.7}) {
    dem::Scene scene = cloud({.friction = 0.4, .restitution = e});
    scene.gravity_m_s2.setZero();
    Simulation simulation(scene, small_solver(1e-6));
    const Vector3d start = momentum(simulation.bodies());
    simulation.run(150);
    ASSERT_GT(simulation.summary().iterations, 0) << "nothing collided";
    EXPECT_LT((momentum(simulation.bodies()) - start).norm(), 1e-14 * start.norm() * 150);
  }
}

TEST(Conservation, LedgerClosesToRoundingWhateverTheSolversAccuracy) {
  const dem::PairLaw dry{.friction = 0.4};
  const dem::PairLaw bouncing{.friction = 0.4, .restitution = 0.7};
  const dem::PairLaw cohesive{.friction = 0.4, .tensile_force_N = 2.0, .rupture_distance_m = 5e-4};
  for (const dem::PairLaw& law : {dry, bouncing, cohesive}) {
    dem::Scene scene = cloud(law);
    add_floor(scene);
    Simulation simulation(scene, small_solver(1e-3));
    simulation.run(250);
    const dem::EnergyLedger& energy = simulation.energy();
    EXPECT_LT(energy.relative_closure(), 1e-12);
    EXPECT_LT(energy.friction_J, 0.0);
    EXPECT_LT(energy.impact_J, 0.0);
    EXPECT_EQ(energy.bond_J != 0.0, law.tensile_force_N != 0.0);
  }
}

TEST(Step, ProblemStatesTheLawOfTheContacts) {
  dem::Scene scene = small_scene({.friction = 0.3, .restitution = 0.5});
  add_floor(scene);
  // One sphere hits the floor while it turns; its lowest point moves along +x at 2 * 0.02 m/s.
  dem::Body& body = add_body(scene, {0.0, 0.0, 0.02}, 0.02);
  body.velocity_m_s = {0.0, 0.0, -1.0};
  body.angular_velocity_rad_s = {0.0, -2.0, 0.0};
  Simulation simulation(scene, small_solver());
  int seen = 0;
  simulation.add_observer([&](const dem::StepView& view) {
    ++seen;
    ASSERT_TRUE(view.problem);
    const auto& problem = *view.problem;
    ASSERT_EQ(problem.rows(), 3);
    EXPECT_EQ(problem.cones()[0].mu, 0.3);
    EXPECT_EQ(problem.cones()[0].theta, 0.3);
    EXPECT_EQ(problem.metadata().name, "small_000000");
    // u_n_minus = -1 closes; a_n = e u_n_minus = -0.5; so the sphere leaves at 0.5 m/s.
    EXPECT_DOUBLE_EQ(problem.w()[0], -0.5);
    EXPECT_NEAR(view.bodies->velocity[0].z(), 0.5, 1e-13);
    // The floor brakes the lowest point, so the reaction points to -x, at the limit of friction.
    const Vector3d reaction = view.contacts->contacts()[0].reaction;
    EXPECT_GT(reaction.z(), 0.0);
    EXPECT_NEAR(view.bodies->velocity[0].x(), reaction.x() / view.bodies->mass[0], 1e-15);
    EXPECT_LT(reaction.x(), 0.0);
    EXPECT_LT(problems::evaluate_eta(*view.standard, view.answer->r), 1e-12);
  });
  simulation.step();
  EXPECT_EQ(seen, 1);
}

TEST(Step, RateOfTheProblemIsTheRelativeVelocityOfTheContact) {
  dem::Scene scene = cloud({.friction = 0.4});
  add_floor(scene);
  Simulation simulation(scene, small_solver(1e-3));
  simulation.add_observer([](const dem::StepView& view) {
    if (!view.problem) return;
    const Eigen::VectorXd u = view.standard->rate(view.answer->r);
    for (std::size_t i = 0; i < view.entered.size(); ++i) {
      const auto& contact = view.contacts->contacts()[static_cast<std::size_t>(view.entered[i])];
      const int start = view.problem->start(static_cast<int>(i));
      const Vector3d rate = u.segment<3>(start) - view.problem->w().segment<3>(start);
      const Vector3d expected =
          dem::frame_of(contact, 3).transpose() * dem::relative_velocity(*view.bodies, contact);
      EXPECT_LT((rate - expected).norm(), 1e-12);
    }
  });
  simulation.run(120);
}

TEST(Step, CohesionReachesTheProblemAsKappa) {
  dem::Scene scene =
      small_scene({.friction = 0.5, .tensile_force_N = 3.0, .rupture_distance_m = 1e-4});
  add_floor(scene);
  add_body(scene, {0.0, 0.0, 0.02}, 0.02);
  Simulation simulation(scene, small_solver());
  simulation.add_observer([&](const dem::StepView& view) {
    EXPECT_DOUBLE_EQ(view.problem->cones()[0].kappa, 3.0 * scene.step_s);
    const double weight = view.bodies->mass[0] * 9.81 * scene.step_s;
    EXPECT_NEAR(view.contacts->contacts()[0].reaction.z(), weight, 1e-15);
    EXPECT_NEAR(view.answer->r[0], weight + 3.0 * scene.step_s, 1e-15);
  });
  simulation.run(3);
}

// The two terms of w exclude each other: a bond that is open has the gap's, so that it can be
// pulled shut; a shut one that is hit has restitution's.
TEST(Step, ContactsHaveEitherTheTermOfTheGapOrThatOfRestitution) {
  dem::Scene scene = small_scene(
      {.friction = 0.5, .restitution = 0.5, .tensile_force_N = 0.1, .rupture_distance_m = 1e-2});
  add_floor(scene);
  add_body(scene, {0.0, 0.0, 0.02}, 0.02).velocity_m_s = {0.0, 0.0, -0.8};
  Simulation simulation(scene, small_solver());
  int open = 0, shut = 0;
  simulation.add_observer([&](const dem::StepView& view) {
    const dem::Contact& contact = view.contacts->contacts()[0];
    ASSERT_TRUE(view.problem && contact.bonded);
    const double u_n = dem::relative_velocity(*view.before, contact).z();
    if (contact.gap > 0.0) {
      ++open;
      EXPECT_DOUBLE_EQ(view.problem->w()[0], contact.gap / scene.step_s);
    } else {
      ++shut;
      EXPECT_DOUBLE_EQ(view.problem->w()[0], 0.5 * std::min(u_n, 0.0));
    }
    EXPECT_DOUBLE_EQ(view.problem->cones()[0].kappa, 0.1 * scene.step_s);
  });
  // It is hit while shut, rises at 0.4 m/s against a bond of an eighth of its weight, and is back
  // after 2 * 0.4 / 11 s.
  simulation.run(1);
  EXPECT_EQ(shut, 1);
  EXPECT_NEAR(simulation.bodies().velocity[0].z(), 0.4, 1e-12);
  simulation.run(100);
  EXPECT_GT(open, 70);
  EXPECT_GT(shut, 1);
}

// A step that is not long at first may become so: what falls 1.6 m is as fast as 5.6 m/s.
TEST(Step, WhatSinksInTooDeepStopsTheRunAndIsNamed) {
  dem::Scene scene = small_scene({.friction = 0.5});
  scene.step_s = 0.01;
  add_floor(scene);
  add_body(scene, {0.0, 0.0, 1.6}, 0.02);
  Simulation simulation(scene, small_solver());
  const std::string error = input_error("small", [&] { simulation.run(100); });
  EXPECT_THAT(error, testing::HasSubstr("body 0 and plane 0 overlap by 0.0"));
  EXPECT_THAT(error, testing::HasSubstr("expected at most 0.02"));
  EXPECT_THAT(error, testing::HasSubstr("smaller step_s (now 0.01)"));
  EXPECT_LT(simulation.bodies().velocity[0].norm(), 6.0);
}

TEST(Step, FrictionlessContactsAreOneDimensional) {
  dem::Scene scene = small_scene({});
  add_floor(scene);
  add_body(scene, {0.0, 0.0, 0.02}, 0.02);
  Simulation simulation(scene, small_solver());
  simulation.add_observer([](const dem::StepView& view) {
    EXPECT_EQ(view.problem->rows(), 1);
    EXPECT_EQ(view.problem->H().nonZeros(), 1);  // n = (0, 0, 1), no torque
  });
  simulation.run(2);
}

TEST(Step, RestingStackIsSolvedByItsWarmStart) {
  dem::Scene scene = small_scene({.friction = 0.5});
  add_floor(scene);
  for (int i = 0; i < 5; ++i) add_body(scene, {0.0, 0.0, 0.02 * (2 * i + 1)}, 0.02);
  Simulation simulation(scene, small_solver(1e-12));
  std::vector<double> eta_of_guess;
  simulation.add_observer([&](const dem::StepView& view) {
    eta_of_guess.push_back(problems::evaluate_eta(*view.standard, *view.guess));
  });
  simulation.run(2);
  EXPECT_DOUBLE_EQ(eta_of_guess[0], 1.0);
  // A sweep that changes less than 1e-12 |q| may be farther than that from the solution.
  EXPECT_LT(eta_of_guess[1], 1e-9);
}

TEST(Step, WarmStartFollowsTheContactsFrame) {
  // A rolling sphere: the contact's point moves on, its reaction stays the same in space.
  dem::Scene scene = cloud({.friction = 0.4, .tensile_force_N = 0.5, .rupture_distance_m = 1e-3});
  add_floor(scene);
  Simulation simulation(scene, small_solver(1e-8));
  std::vector<dem::Contact> last;
  simulation.add_observer([&](const dem::StepView& view) {
    for (std::size_t i = 0; i < view.entered.size(); ++i) {
      const auto& now = view.contacts->contacts()[static_cast<std::size_t>(view.entered[i])];
      const auto old = std::find_if(last.begin(), last.end(), [&](const dem::Contact& contact) {
        return contact.body == now.body && contact.other == now.other;
      });
      Vector3d expected = Vector3d::Zero();
      if (old != last.end()) expected = dem::frame_of(now, 3).transpose() * old->reaction;
      expected[0] += view.problem->cones()[i].kappa;
      const Vector3d guess = view.guess->segment<3>(view.problem->start(static_cast<int>(i)));
      EXPECT_LT((guess - expected).norm(), 1e-15);
    }
    last = view.contacts->contacts();
  });
  simulation.run(100);
}

TEST(Step, PlanesGoAtTheirTime) {
  dem::Scene scene = small_scene({.friction = 0.5});
  add_floor(scene);
  scene.planes[0].until_s = 0.1;
  add_body(scene, {0.0, 0.0, 0.02}, 0.02);
  Simulation simulation(scene, small_solver());
  simulation.run(100);
  EXPECT_NEAR(simulation.bodies().position[0].z(), 0.02, 1e-13);
  simulation.run(200);
  EXPECT_NEAR(simulation.bodies().velocity[0].z(), -0.981, 1e-10);
}

TEST(Step, SameSeedSameMotionOtherSeedOtherMotion) {
  const auto final_positions = [](std::int64_t seed) {
    dem::Scene scene = cloud({.friction = 0.4});
    add_floor(scene);
    scene.seed = seed;
    Simulation simulation(scene, small_solver(1e-6));
    simulation.run(120);
    return simulation.bodies().position;
  };
  EXPECT_EQ(final_positions(7), final_positions(7));
  EXPECT_NE(final_positions(7), final_positions(8));
}

TEST(Step, NotFiniteAnswerStopsTheRunAndNamesTheStep) {
  dem::Scene scene = small_scene({.friction = 0.5});
  add_floor(scene);
  add_body(scene, {0.0, 0.0, 0.02}, 0.02);
  Simulation simulation(scene, [](const auto& standard, const auto&) {
    engine::StepAnswer answer;
    answer.r.setConstant(standard.rows(), std::nan(""));
    answer.status = "diverged";
    return answer;
  });
  EXPECT_THROW(simulation.step(), std::runtime_error);
}

}  // namespace
}  // namespace conebench::test
