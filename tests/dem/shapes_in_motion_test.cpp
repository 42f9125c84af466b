// Bodies other than balls: known answers and what holds for any motion.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "dem/simulation.h"
#include "problems/error.h"
#include "tests/dem/scene_helper.h"
#include "tests/engine/small_solver.h"

namespace conebench::test {
namespace {

using dem::Simulation;
using Eigen::Vector3d;

constexpr double kGravity = 9.81;
constexpr double kDegree = std::numbers::pi / 180.0;

// A box at rest on the slope z = -x tan(angle), its sides along the slope, across it and up.
dem::Scene box_on_slope(double angle, double friction, const Vector3d& size_m, int dimension) {
  dem::Scene scene = small_scene({.friction = friction});
  scene.dimension = dimension;
  dem::Plane plane;
  plane.normal = {std::sin(angle), 0.0, std::cos(angle)};
  plane.material = "grain";
  scene.planes.push_back(plane);
  add_shape(scene, "block", dem::Box{0.5 * size_m});
  dem::Body& body = add_body(scene, 0.5 * size_m.z() * plane.normal, "block");
  body.rotation_rad = {0.0, angle, 0.0};
  return scene;
}

class Block : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimension, Block, testing::Values(2, 3));

TEST_P(Block, SlidesAboveTheAngleOfFrictionAndNotBelow) {
  const double friction = 0.5, critical = std::atan(friction);
  const Vector3d size(0.2, 0.1, 0.05);
  Simulation rests(box_on_slope(critical - 0.1 * kDegree, friction, size, GetParam()),
                   small_solver(1e-13));
  rests.run(500);
  EXPECT_LT(rests.bodies().velocity[0].norm(), 1e-9);
  const double angle = critical + 0.1 * kDegree;
  Simulation slides(box_on_slope(angle, friction, size, GetParam()), small_solver(1e-13));
  slides.run(500);
  const double speed = 0.5 * kGravity * (std::sin(angle) - friction * std::cos(angle));
  EXPECT_NEAR(slides.bodies().velocity[0].norm(), speed, 1e-6 * speed);
  EXPECT_LT(slides.bodies().angular_velocity[0].norm(), 1e-6);
}

TEST_P(Block, TipsWhereItsWeightLeavesItsBaseAndNotBefore) {
  const Vector3d size(0.1, 0.1, 0.2);
  const double critical = std::atan(size.x() / size.z());
  Simulation rests(box_on_slope(critical - 0.1 * kDegree, 5.0, size, GetParam()),
                   small_solver(1e-13));
  rests.run(500);
  EXPECT_LT(rests.bodies().angular_velocity[0].norm(), 1e-9);
  Simulation tips(box_on_slope(critical + 0.1 * kDegree, 5.0, size, GetParam()),
                  small_solver(1e-13));
  tips.run(100);
  // About its lower edge: J d(omega)/dt = m g d sin(0.1 deg), J = m (a^2 + b^2) / 3, d^2 = J / m
  // * 3 / 4; the lever grows by 1 % in that time.
  const double square = size.x() * size.x() + size.z() * size.z();
  const double rate =
      0.1 * kGravity * 0.5 * std::sqrt(square) * std::sin(0.1 * kDegree) / (square / 3.0);
  EXPECT_NEAR(tips.bodies().angular_velocity[0].y(), rate, 0.15 * rate);
  EXPECT_GT(tips.bodies().angular_velocity[0].y(), 0.9 * rate);
}

TEST_P(Block, PressesWithItsWeight) {
  Simulation simulation(box_on_slope(0.0, 0.5, {0.2, 0.1, 0.05}, GetParam()), small_solver(1e-13));
  simulation.run(10);
  Vector3d sum = Vector3d::Zero();
  for (const dem::Contact& contact : simulation.contacts().contacts()) sum += contact.reaction;
  EXPECT_EQ(simulation.contacts().contacts().size(), GetParam() == 2 ? 2u : 4u);
  const double weight = 0.2 * 0.1 * 0.05 * 2500.0 * kGravity;
  EXPECT_LT((sum / 1e-3 - weight * Vector3d::UnitZ()).norm(), 1e-9 * weight);
}

Vector3d angular_momentum(const dem::Bodies& bodies) {
  Vector3d sum = Vector3d::Zero();
  for (int i = 0; i < bodies.count(); ++i) {
    if (!bodies.is_free(i)) continue;
    const auto b = static_cast<std::size_t>(i);
    sum += dem::spin(bodies, i) + bodies.mass[b] * bodies.position[b].cross(bodies.velocity[b]);
  }
  return sum;
}

// A box that turns about its middle axis, slightly off it: it tumbles.
dem::Scene tumbling(double step_s) {
  dem::Scene scene = small_scene({.friction = 0.3});
  scene.gravity_m_s2.setZero();
  scene.step_s = step_s;
  add_shape(scene, "book", dem::Box{{0.1, 0.07, 0.02}});
  add_body(scene, Vector3d::Zero(), "book").angular_velocity_rad_s = {0.05, 5.0, 0.05};
  return scene;
}

TEST(FreeFlight, TumblingKeepsAngularMomentumToTheOrderOfTheStep) {
  const auto loss = [](double step_s) {
    Simulation simulation(tumbling(step_s), small_solver());
    const Vector3d start = angular_momentum(simulation.bodies());
    double turned = 0.0;
    while (simulation.time_s() < 3.0) {
      simulation.step();
      const Eigen::Quaterniond& q = simulation.bodies().orientation[0];
      turned = std::max(turned, q.angularDistance(Eigen::Quaterniond::Identity()));
    }
    EXPECT_GT(turned, 3.0);
    EXPECT_LT(simulation.energy().relative_closure(), 1e-12);
    EXPECT_NE(simulation.energy().gyro_J, 0.0);
    return (angular_momentum(simulation.bodies()) - start).norm() / start.norm();
  };
  const double coarse = loss(2e-3), fine = loss(1e-3);
  EXPECT_LT(fine, 0.02);
  EXPECT_NEAR(coarse / fine, 2.0, 0.3);
}

// A box thrown on the floor, as `parts` describe it in a frame that is moved and turned from its
// own.
dem::Scene thrown(const std::vector<dem::ScenePart>& parts, const dem::Pose& frame) {
  dem::Scene scene = small_scene({.friction = 0.3});
  add_floor(scene);
  scene.shapes.push_back({"block", parts});
  const dem::Pose pose =
      dem::Pose{{0.0, 0.0, 0.2},
                Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3) / std::sqrt(14.0)))} *
      frame.inverse();
  dem::Body& body = add_body(scene, pose.position, "block");
  const Eigen::AngleAxisd turn(pose.orientation);
  body.rotation_rad = turn.angle() * turn.axis();
  body.velocity_m_s = {0.5, -0.3, -1.0};
  body.angular_velocity_rad_s = {4.0, -7.0, 3.0};
  return scene;
}

// Centre of mass, principal axes, moments, poses of parts, touches: all of them matter here.
TEST(Shapes, TheSameSolidInOtherWordsMovesTheSame) {
  const Vector3d half(0.05, 0.03, 0.02);
  const auto part = [](const dem::Piece& piece, const dem::Pose& pose) {
    const Eigen::AngleAxisd turn(pose.orientation);
    return dem::ScenePart{piece, pose.position, turn.angle() * turn.axis(), {}};
  };
  const dem::Pose frame{
      {0.3, -0.2, 0.1},
      Eigen::Quaterniond(Eigen::AngleAxisd(1.1, Vector3d(2, -1, 1) / std::sqrt(6.0)))};
  dem::Hull hull;
  for (int k = 0; k < 8; ++k) {
    const Vector3d corner(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0);
    hull.points_m.push_back(frame * Vector3d(half.cwiseProduct(corner)));
  }
  const auto speeds = [&](const std::vector<dem::ScenePart>& parts, const dem::Pose& in) {
    Simulation simulation(thrown(parts, in), small_solver());
    std::vector<Vector3d> found;
    // Longer, and rounding grows beyond the tolerance at each new impact.
    while (simulation.time_s() < 0.25) {
      simulation.step();
      found.push_back(simulation.bodies().velocity[0]);
      found.push_back(simulation.bodies().angular_velocity[0]);
    }
    EXPECT_GT(simulation.summary().most_cones, 0);
    EXPECT_LT(simulation.energy().friction_J, 0.0);
    return found;
  };
  const auto box = speeds({part(dem::Box{half}, dem::Pose{})}, dem::Pose{});
  const auto expect_same = [&](const std::vector<Vector3d>& other) {
    double worst = 0.0;
    for (std::size_t k = 0; k < box.size(); ++k)
      worst = std::max(worst, (box[k] - other[k]).norm());
    EXPECT_LT(worst, 1e-8);
  };
  expect_same(speeds({part(dem::Box{half}, frame)}, frame));
  expect_same(speeds({part(hull, dem::Pose{})}, frame));
}

// Ball, box, capsule, cylinder, hull and a compound thrown together.
dem::Scene jumble(const dem::PairLaw& law) {
  dem::Scene scene = small_scene(law);
  add_shape(scene, "box", dem::Box{{0.04, 0.03, 0.02}});
  add_shape(scene, "capsule", dem::Capsule{0.02, 0.03});
  add_shape(scene, "cylinder", dem::Cylinder{0.03, 0.02});
  add_shape(scene, "hull",
            dem::Hull{{{0, 0, 0}, {0.06, 0, 0}, {0, 0.07, 0}, {0, 0, 0.05}, {0.05, 0.05, 0.05}}});
  scene.shapes.push_back(
      {"dumb-bell",
       {{dem::Ball{0.02}, {-0.03, 0.0, 0.0}, Vector3d::Zero(), {}},
        {dem::Ball{0.03}, {0.03, 0.0, 0.0}, Vector3d::Zero(), {}},
        {dem::Box{{0.03, 0.01, 0.01}}, Vector3d::Zero(), Vector3d::Zero(), {}}}});
  int place = 0;
  for (const char* shape : {"box", "capsule", "cylinder", "hull", "dumb-bell", ""}) {
    const Vector3d at(0.15 * (place % 2), 0.15 * (place / 2 % 2), 0.1 + 0.15 * (place / 4));
    dem::Body& body = *shape ? add_body(scene, at, shape) : add_body(scene, at, 0.03);
    body.velocity_m_s = 2.0 * (Vector3d(0.07, 0.07, 0.15) - at).normalized();
    body.angular_velocity_rad_s = {3.0, -2.0, 1.0 + place};
    ++place;
  }
  return scene;
}

TEST(Jumble, MomentaAreKeptInCollisions) {
  for (const double e : {0.0, 0.6}) {
    dem::Scene scene = jumble({.friction = 0.4, .restitution = e});
    scene.gravity_m_s2.setZero();
    scene.step_s = 1e-4;
    Simulation simulation(scene, small_solver(1e-6));
    const auto momentum = [&] {
      Vector3d sum = Vector3d::Zero();
      for (std::size_t i = 0; i < 6; ++i) {
        sum += simulation.bodies().mass[i] * simulation.bodies().velocity[i];
      }
      return sum;
    };
    const Vector3d start = momentum(), turning = angular_momentum(simulation.bodies());
    simulation.run(1000);
    EXPECT_GT(simulation.summary().most_cones, 1);
    EXPECT_LT((momentum() - start).norm(), 1e-12 * simulation.bodies().mass[0]);
    // Positions move with the new velocity and the inertia turns after it: order of the step.
    EXPECT_LT((angular_momentum(simulation.bodies()) - turning).norm(), 0.01 * turning.norm());
  }
}

TEST(Jumble, LedgerClosesToRounding) {
  const dem::PairLaw dry{.friction = 0.4};
  const dem::PairLaw bouncing{.friction = 0.4, .restitution = 0.7};
  const dem::PairLaw cohesive{.friction = 0.4, .tensile_force_N = 2.0, .rupture_distance_m = 5e-4};
  for (const dem::PairLaw& law : {dry, bouncing, cohesive}) {
    dem::Scene scene = jumble(law);
    add_floor(scene);
    scene.motions.push_back({"shaker", dem::Shake{{0.0, 0.0, 0.01}, 5.0, 0.0, 10.0}});
    scene.planes.back().motion = "shaker";
    Simulation simulation(scene, small_solver(1e-3));
    simulation.run(500);
    const dem::EnergyLedger& energy = simulation.energy();
    EXPECT_LT(energy.relative_closure(), 1e-12);
    EXPECT_LT(energy.friction_J, 0.0);
    EXPECT_NE(energy.driven_J, 0.0);
    EXPECT_NE(energy.gyro_J, 0.0);
  }
}

TEST(Jumble, ComesToRestOnTheFloorAndPressesWithItsWeight) {
  dem::Scene scene = jumble({.friction = 0.4});
  add_floor(scene);
  Simulation simulation(scene, small_solver(1e-8));
  simulation.run(4000);
  double weight = 0.0;
  for (std::size_t i = 0; i < 6; ++i) weight += simulation.bodies().mass[i] * kGravity;
  Vector3d pressed = Vector3d::Zero();
  for (const dem::Contact& contact : simulation.contacts().contacts()) {
    if (simulation.bodies().is_plane(contact.other)) pressed += contact.reaction / scene.step_s;
  }
  // Balls and what has round ends roll on for ever; the box and the hull do not.
  EXPECT_LT(simulation.bodies().velocity[0].norm(), 1e-6);
  EXPECT_LT(simulation.bodies().velocity[3].norm(), 1e-6);
  EXPECT_NEAR(pressed.z(), weight, 0.1 * weight);
  EXPECT_LT(simulation.summary().deepest_overlap_m, 1e-3);
}

TEST(Jumble, RestartGoesOnBitForBit) {
  dem::Scene scene = jumble({.friction = 0.4, .tensile_force_N = 1.0, .rupture_distance_m = 1e-3});
  add_floor(scene);
  scene.motions.push_back({"belt", dem::Slide{{0.3, 0.0, 0.0}, 0.0, 10.0}});
  scene.planes.back().motion = "belt";
  const auto path = std::filesystem::path(testing::TempDir()) / "jumble.cbor";
  Simulation whole(scene, small_solver(1e-6)), part(scene, small_solver(1e-6));
  whole.run(260);
  whole.save(path);
  whole.run(400);
  part.restart(path);
  EXPECT_EQ(part.summary().steps, 260);
  part.run(400);
  EXPECT_EQ(part.bodies().position, whole.bodies().position);
  EXPECT_EQ(part.bodies().angular_velocity, whole.bodies().angular_velocity);
  EXPECT_EQ(part.summary().iterations, whole.summary().iterations);
  EXPECT_EQ(part.energy().friction_J, whole.energy().friction_J);
  std::filesystem::remove(path);
}

TEST(Jumble, CheckpointOfAnotherSceneIsRefused) {
  const auto path = std::filesystem::path(testing::TempDir()) / "other.cbor";
  Simulation one(jumble({.friction = 0.4}), small_solver());
  one.save(path);
  Simulation other(jumble({.friction = 0.5}), small_solver());
  EXPECT_THROW(other.restart(path), problems::InputError);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) / 2);
  Simulation same(jumble({.friction = 0.4}), small_solver());
  EXPECT_THROW(same.restart(path), problems::InputError);
  EXPECT_EQ(same.summary().steps, 0);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace conebench::test
