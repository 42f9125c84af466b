// Motions with an answer that is known beforehand.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>

#include "problems/error.h"
#include "tests/mpm/engine_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using mpm::Condition;
using mpm::Scene;
using mpm::Simulation;

constexpr double kGravity = 9.81;

// ---- Flight

// A block in the air, thrown so that it crosses cells askew.
Scene thrown(int dim) {
  Scene scene = open_scene(dim == 2 ? std::vector{10, 10} : std::vector{7, 7, 7});
  mpm::Block& block = add_block(scene, Vector3d::Constant(2.3), Vector3d::Constant(4.6));
  block.velocity_m_s = flat(dim, {0.7, 0.4, 1.1});
  block.jitter = 0.5;
  return scene;
}

TEST(Flight, KeepsMomentumAndFallsAtG) {
  for (const int dim : {2, 3}) {
    const Scene scene = thrown(dim);
    Simulation simulation(scene, step_solver("auto", 1e-6));
    const double mass = mass_of(simulation);
    const Vector3d start = momentum_of(simulation);
    for (int k = 0; k < 40; ++k) {
      simulation.step();
      const Vector3d expected = start + mass * simulation.time_s() * scene.gravity_m_s2;
      // Rounding of some hundred particles and 40 steps, at 1 m/s.
      EXPECT_LT((momentum_of(simulation) - expected).norm(), 1e-13 * mass) << dim << "D";
    }
    const Vector3d v = scene.blocks[0].velocity_m_s + simulation.time_s() * scene.gravity_m_s2;
    for (const Vector3d& of_particle : simulation.particles().velocity) {
      EXPECT_LT((of_particle - v).norm(), 1e-5) << "no stress may act on a block in flight";
    }
  }
}

TEST(Flight, IsTheSameForParticlesOnFacesOfCells) {
  Scene scene = open_scene({8, 8});
  mpm::Block& block = add_block(scene, {2.5, 2.5, 0.0}, {4.5, 4.5, 0.0});
  block.particles_per_cell = 1;
  block.velocity_m_s = {0.7, 0.4, 0.0};
  Simulation simulation(scene, step_solver("auto", 1e-8));
  const double mass = mass_of(simulation);
  const Vector3d start = momentum_of(simulation);
  simulation.step();
  const Vector3d expected = start + mass * simulation.time_s() * scene.gravity_m_s2;
  EXPECT_LT((momentum_of(simulation) - expected).norm(), 1e-13 * mass);
}

TEST(Flight, BlocksThatCollideKeepTheirMomentum) {
  for (const int dim : {2, 3}) {
    Scene scene = thrown(dim);
    scene.gravity_m_s2.setZero();
    mpm::Block& other = add_block(scene, Vector3d::Constant(4.8), Vector3d::Constant(6.1));
    other.velocity_m_s = flat(dim, {-3.0, -1.0, -2.0});
    // Momentum is kept whatever the solver's accuracy: r acts on two sides.
    Simulation simulation(scene, step_solver("gs", 1e-2));
    const double mass = mass_of(simulation);
    const Vector3d start = momentum_of(simulation);
    const double kinetic = simulation.state().kinetic_J;
    run(simulation, 30);
    EXPECT_LT((momentum_of(simulation) - start).norm(), 1e-12 * mass);
    EXPECT_LT(simulation.state().kinetic_J, 0.9 * kinetic) << "they did not collide";
  }
}

// ---- Beds at rest

TEST(Bed, OnTheGridStaysAtRest) {
  Scene scene = box_scene({8, 6});
  scene.step_s = 4e-3;
  add_block(scene, Vector3d::Zero(), {8.0, 4.0, 0.0});
  Simulation simulation(scene, step_solver("auto", 1e-10));
  double fastest = 0.0;
  for (int k = 0; k < 1000; ++k) {
    simulation.step();
    fastest = std::max(fastest, simulation.state().fastest_m_s);
  }
  EXPECT_EQ(simulation.summary().unconverged_steps, 0);
  EXPECT_LE(fastest, 1e-8 * std::sqrt(kGravity * 0.4));
}

// Runs the first step of a bed that fills `depth` cells of spacing 0.8 m / depth in a shaft two
// cells wide, and shows it to `look`.
void first_step_of_a_bed(double depth, double friction, const mpm::Observer& look) {
  const double spacing = 0.8 / depth;
  const int layers = static_cast<int>(depth) + 2;
  Scene scene = box_scene({2, layers});
  scene.grid.size_m = {2.0 * spacing, layers * spacing, 0.0};
  scene.material.friction = friction;
  scene.step_s = 1e-4;
  mpm::Block& block = add_block(scene, Vector3d::Zero(), {2.0, depth, 0.0});
  block.particles_per_cell = 4;
  Simulation simulation(scene, step_solver("auto", 1e-9));
  simulation.add_observer(look);
  simulation.step();
}

// Largest error of the pressure at the nodes, as a share of that at the foot. Without friction, so
// that it is unique. The grains carry rho g depth (the bulk phi times as much).
double pressure_error(double depth) {
  double worst = 0.0;
  first_step_of_a_bed(depth, 0.0, [&](const mpm::StepView& view) {
    for (int i = 0; i < view.nodes->count(); ++i) {
      const int node = view.nodes->index[static_cast<std::size_t>(i)];
      const double below = std::max(0.0, 0.8 - view.scene->grid.position(node).y());
      const double p = view.answer->r[view.problem->start(i)] / view.h;
      worst = std::max(worst, std::abs(p - 1500.0 * kGravity * below));
    }
  });
  return worst / (1500.0 * kGravity * 0.8);
}

TEST(Bed, PressureIsHydrostaticWhereItEndsOnTheGrid) {
  // eta of 1e-9 is of the rate of free fall; W's condition grows as depth^2.
  for (const double depth : {4.0, 8.0, 16.0}) EXPECT_LT(pressure_error(depth), 1e-6);
}

TEST(Bed, PressureIsHydrostaticToFirstOrderWhereItEndsBetweenNodes) {
  const std::array<double, 3> errors = {pressure_error(4.5), pressure_error(8.5),
                                        pressure_error(16.5)};
  EXPECT_GT(std::log(errors[0] / errors[1]) / std::log(8.5 / 4.5), 0.9);
  EXPECT_GT(std::log(errors[1] / errors[2]) / std::log(16.5 / 8.5), 0.9);
}

// With friction the stress is not unique, but each layer carries what is above it: its vertical
// stress has the mean of the hydrostatic one.
TEST(Bed, LayersOfSandCarryTheWeightAbove) {
  first_step_of_a_bed(6.0, 0.4, [](const mpm::StepView& view) {
    std::vector<double> vertical(7, 0.0);
    for (int i = 0; i < view.nodes->count(); ++i) {
      const auto at = view.scene->grid.place(view.nodes->index[static_cast<std::size_t>(i)]);
      const Eigen::Vector3d r = view.answer->r.segment<3>(view.problem->start(i));
      const double share = at.x() == 1 ? 0.5 : 0.25;
      vertical[static_cast<std::size_t>(at.y())] += share * mpm::to_tensor<2>(r)(1, 1) / view.h;
    }
    const double foot = 1500.0 * kGravity * 0.8;
    for (std::size_t layer = 0; layer < 7; ++layer) {
      EXPECT_NEAR(vertical[layer] / foot, 1.0 - static_cast<double>(layer) / 6.0, 1e-6);
    }
  });
}

// Kinetic energy with the affine part, that of the grid's velocities at the particle, and
// potential.
double energy_of(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  const auto& particles = simulation.particles();
  double energy = 0.0;
  for (std::size_t p = 0; p < particles.count(); ++p) {
    const double m = scene.material.density_kg_m3 * particles.volume[p];
    energy += m * (0.5 * particles.velocity[p].squaredNorm() -
                   scene.gravity_m_s2.dot(particles.position[p]));
    for (int a = 0; a < scene.grid.dim; ++a) {
      const double l = scene.grid.spacing(a);
      const double place = (particles.position[p][a] - scene.grid.low_m[a]) / l;
      const double s = place - std::floor(place);
      energy += 0.5 * m * s * (1.0 - s) * l * l * particles.affine[p].col(a).squaredNorm();
    }
  }
  return energy;
}

TEST(Bed, OffTheGridSettlesWithoutGainingEnergy) {
  Scene scene = box_scene({6, 6});
  mpm::Block& block = add_block(scene, {0.0, 0.4, 0.0}, {6.0, 3.37, 0.0});
  block.jitter = 0.8;
  block.fraction = 0.57;
  Simulation simulation(scene, step_solver("auto", 1e-7));
  const double start = energy_of(simulation);
  double last = start, last_plain = simulation.state().kinetic_J + simulation.state().potential_J;
  for (int k = 0; k < 400; ++k) {
    simulation.step();
    const double energy = energy_of(simulation);
    const double plain = simulation.state().kinetic_J + simulation.state().potential_J;
    // Rounding of 72 particles' energies.
    EXPECT_LE(energy, last + 1e-12 * std::abs(start)) << "step " << k;
    EXPECT_LE(plain, last_plain + 1e-12 * std::abs(start)) << "step " << k;
    last = energy;
    last_plain = plain;
  }
  EXPECT_LT(last, start - 0.05 * mass_of(simulation) * kGravity * 0.3) << "it did not fall";
  EXPECT_LT(simulation.state().kinetic_J, 1e-3 * (start - last));
}

// ---- Slopes

// Acceleration along the slope, in units of g, of the middle of a long thin layer at rest on a
// rough plane. Plane flow of mu = 0.4. Its ends are free and slump at once; so near the friction
// angle what is 30 depths away is still felt (0.003 g at 2 degrees below it, 0 at 4).
double slope_acceleration(double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  Scene scene = open_scene({128, 4});
  scene.gravity_m_s2 = kGravity * Vector3d(std::sin(angle), -std::cos(angle), 0.0);
  scene.walls[2].condition = Condition::kStick;
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

// ---- Steps

TEST(Step, KeepsTheCflNumber) {
  Scene scene = thrown(2);
  scene.blocks[0].velocity_m_s = {30.0, 0.0, 0.0};  // 0.6 cells in step_s
  Simulation simulation(scene, step_solver("auto", 1e-6));
  std::vector<double> sizes;
  simulation.add_observer([&](const mpm::StepView& view) {
    sizes.push_back(view.h);
    for (const Vector3d& v : view.particles->velocity) {
      EXPECT_LE(view.h * v.cwiseAbs().maxCoeff() / 0.1, scene.cfl * (1.0 + 1e-12));
    }
  });
  run(simulation, 4);
  EXPECT_EQ(sizes, std::vector<double>(4, 1e-3));
  EXPECT_EQ(simulation.time_s(), 4e-3);
  EXPECT_EQ(simulation.summary().repeated_steps, 0);
}

// A solver whose first `wrong` answers push apart what should lie still.
engine::StepSolver pushing(int wrong, double times) {
  return [wrong, times, calls = 0, right = step_solver("gs", 1e-8)](
             const problems::Problem& standard, const Eigen::VectorXd& guess) mutable {
    engine::StepAnswer answer = right(standard, guess);
    if (calls++ < wrong) answer.r *= times;
    return answer;
  };
}

TEST(Step, IsRepeatedAtHalfTheSizeWhereAParticleWouldCrossACell) {
  Scene scene = box_scene({6, 6});
  add_block(scene, Vector3d::Zero(), {6.0, 3.0, 0.0});
  Simulation simulation(scene, pushing(1, 1e5));
  const auto before = simulation.particles().position;
  double h = 0.0;
  simulation.add_observer([&](const mpm::StepView& view) { h = view.h; });
  simulation.step();
  EXPECT_EQ(simulation.summary().repeated_steps, 1);
  EXPECT_EQ(simulation.summary().steps, 1);
  EXPECT_EQ(h, 0.5 * scene.step_s);
  for (std::size_t p = 0; p < before.size(); ++p) {
    const Vector3d moved = simulation.particles().position[p] - before[p];
    EXPECT_LT(moved.norm(), 1e-3 * 0.1) << "the first answer left a trace";
  }
  simulation.step();
  EXPECT_EQ(simulation.time_s(), scene.step_s) << "the rest of the period comes next";
}

TEST(Step, NeverMovesAParticleByMoreThanACell) {
  Scene scene = box_scene({6, 6});
  add_block(scene, Vector3d::Zero(), {6.0, 3.0, 0.0});
  Simulation simulation(scene, pushing(3, 3e4));
  auto before = simulation.particles().position;
  for (int k = 0; k < 5; ++k) {
    simulation.step();
    for (std::size_t p = 0; p < before.size(); ++p) {
      const Vector3d moved = simulation.particles().position[p] - before[p];
      EXPECT_LE(moved.cwiseAbs().maxCoeff(), 0.1 * (1.0 + 1e-12));
    }
    before = simulation.particles().position;
  }
  EXPECT_GE(simulation.summary().repeated_steps, 1);
}

TEST(Step, GivesUpWhereNoSizeIsShortEnough) {
  Scene scene = box_scene({6, 6});
  add_block(scene, Vector3d::Zero(), {6.0, 3.0, 0.0});
  Simulation simulation(scene, [](const problems::Problem& standard, const Eigen::VectorXd&) {
    engine::StepAnswer answer;
    answer.r = Eigen::VectorXd::Zero(standard.rows());
    answer.r[standard.start(standard.cone_count() / 2)] = 1e12;
    return answer;
  });
  EXPECT_THROW(simulation.step(), problems::InputError);
}

TEST(Step, TimeEndsAtTheDuration) {
  Scene scene = thrown(2);
  scene.duration_s = 0.02;
  Simulation simulation(scene, step_solver("auto", 1e-6));
  while (!simulation.finished()) simulation.step();
  EXPECT_NEAR(simulation.time_s(), 0.02, 1e-15);
  EXPECT_EQ(simulation.summary().steps, 10);
}

// ---- Walls

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
  scene.walls[0] = {Condition::kFrictional, 0.2};
  scene.walls[1].condition = Condition::kStick;
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
    scene.walls[2] = {Condition::kFrictional, mu};
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
  scene.walls[2] = {Condition::kFrictional, mu_w};
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

// ---- Bodies

Scene with_ball(int dim) {
  Scene scene = dim == 2 ? box_scene({14, 12}) : box_scene({8, 6, 7});
  scene.walls[static_cast<std::size_t>(2 * dim - 2)].condition = Condition::kSlip;
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
    for (mpm::Wall& wall : scene.walls) wall.condition = Condition::kFree;
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

// ---- Barriers

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
  for (const Condition condition : {Condition::kSlip, Condition::kStick}) {
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
