// Runs on a grid that is refined at the heap's boundary, their files among them.

#include <gtest/gtest.h>

#include <filesystem>

#include "problems/problem_file.h"
#include "tests/engine/own_folder.h"
#include "tests/engine/small_solver.h"
#include "tests/mpm/engine_helper.h"
#include "tests/mpm/refined_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using mpm::Nodes;
using mpm::Particles;
using mpm::Scene;
using mpm::Simulation;

// Where the sand is looser than half of the densest, every cell that it touches is cut.
TEST(RefinedRun, OfLooseSandIsTheRunOnTheGridOfHalvesBitForBit) {
  Scene scene = box_scene({8, 8});
  scene.grid.refine = mpm::Refine::kBoundary;
  mpm::Block& block = add_block(scene, {2.0, 1.0, 0.0}, {6.0, 5.0, 0.0});
  block.fraction = 0.2;
  block.jitter = 0.5;
  Scene halves = scene;
  halves.grid = scene.grid.finest();
  halves.blocks[0].particles_per_cell = 1;
  Simulation refined(scene, small_solver(1e-6)), regular(halves, small_solver(1e-6));
  ASSERT_EQ(refined.particles().position, regular.particles().position);
  run(refined, 30);
  run(regular, 30);
  EXPECT_EQ(refined.particles().position, regular.particles().position);
  EXPECT_EQ(refined.particles().stress, regular.particles().stress);
  EXPECT_EQ(refined.summary().iterations, regular.summary().iterations);
}

TEST(RefinedRun, InFlightKeepsMomentumAndFallsAtG) {
  for (const int dim : {2, 3}) {
    Scene scene = heap(dim);
    scene.blocks[0].velocity_m_s = flat(dim, {0.7, 0.4, 0.5});
    Simulation simulation(scene, step_solver("auto", 1e-6));
    const double mass = mass_of(simulation);
    const Vector3d start = momentum_of(simulation);
    for (int k = 0; k < 30; ++k) {
      simulation.step();
      const Vector3d expected = start + mass * simulation.time_s() * scene.gravity_m_s2;
      // Rounding of some thousand particles and 30 steps, at 1 m/s.
      EXPECT_LT((momentum_of(simulation) - expected).norm(), 1e-12 * mass) << dim << "D";
    }
    EXPECT_EQ(simulation.summary().left_particles, 0);
  }
}

// Without friction the pressure is unique: linear in the depth, which whole and cut cells hold.
TEST(RefinedRun, PressureOfABedIsHydrostatic) {
  Scene scene = box_scene({3, 8});
  scene.grid.refine = mpm::Refine::kBoundary;
  scene.material.friction = 0.0;
  scene.step_s = 1e-4;
  add_block(scene, Vector3d::Zero(), {3.0, 5.0, 0.0}).particles_per_cell = 4;
  Simulation simulation(scene, step_solver("auto", 1e-9));
  const double foot = 1500.0 * kGravity * 0.5;
  simulation.add_observer([&](const mpm::StepView& view) {
    const Nodes& nodes = *view.nodes;
    expect_both_kinds(nodes);
    for (int i = 0; i < nodes.count(); ++i) {
      const auto slot = static_cast<std::size_t>(i);
      const double y = nodes.mesh.grid().position(nodes.index[slot]).y();
      const double p = view.answer->r[view.problem->start(i)] / view.h;
      EXPECT_NEAR(p / foot, std::max(0.0, 1.0 - y / 0.5), 1e-6) << "y = " << y;
    }
  });
  simulation.step();
}

TEST(RefinedRun, OfABedStaysAtRest) {
  Scene scene = box_scene({8, 6});
  scene.grid.refine = mpm::Refine::kBoundary;
  scene.step_s = 4e-3;
  add_block(scene, Vector3d::Zero(), {8.0, 4.0, 0.0}).particles_per_cell = 4;
  Simulation simulation(scene, step_solver("auto", 1e-10));
  double fastest = 0.0;
  for (int k = 0; k < 200; ++k) {
    simulation.step();
    fastest = std::max(fastest, simulation.state().fastest_m_s);
  }
  EXPECT_LE(fastest, 1e-8 * std::sqrt(kGravity * 0.4));
}

TEST(RefinedRun, OfAFallingHeapGainsNoEnergy) {
  Scene scene = box_scene({12, 6});
  scene.grid.refine = mpm::Refine::kBoundary;
  scene.material.cohesion_Pa = 200.0;
  scene.material.law = mpm::Law::kDenseOnly;
  add_block(scene, Vector3d::Zero(), {4.0, 5.0, 0.0}).jitter = 0.5;
  Simulation simulation(scene, step_solver("auto", 1e-6));
  const auto energy = [&] { return simulation.state().kinetic_J + simulation.state().potential_J; };
  const double start = energy();
  double last = start;
  for (int k = 0; k < 150; ++k) {
    simulation.step();
    EXPECT_LE(energy(), last + 1e-12 * start) << "step " << k;
    last = energy();
  }
  EXPECT_LT(last, 0.8 * start) << "it did not fall";
}

TEST(RefinedRun, NeverMovesAParticleByMoreThanTheShareOfAHalf) {
  Scene scene = heap(2);
  scene.blocks[0].velocity_m_s = {20.0, 0.0, 0.0};
  Simulation simulation(scene, step_solver("auto", 1e-6));
  const double x = simulation.particles().position[0].x();
  simulation.step();
  const double moved = simulation.particles().position[0].x() - x;
  EXPECT_LE(moved, scene.cfl * 0.05 * (1.0 + 1e-12));
  EXPECT_GT(moved, 0.5 * scene.cfl * 0.05);
}

class RefinedFiles : public OwnFolder {};

// A cohesive heap under a falling ball: the cells that are cut change from step to step.
Scene busy() {
  Scene scene = box_scene({8, 7});
  scene.grid.refine = mpm::Refine::kBoundary;
  scene.material.cohesion_Pa = 300.0;
  mpm::Block& block = add_block(scene, {3.0, 0.0, 0.0}, {7.9, 4.0, 0.0});
  block.jitter = 0.6;
  block.velocity_m_s = {-1.0, 0.0, 0.0};
  mpm::Body ball;
  ball.motion = mpm::Motion::kFree;
  ball.radius_m = 0.11;
  ball.density_kg_m3 = 3000.0;
  ball.centre_m = {0.6, 0.52, 0.0};
  ball.velocity_m_s = {0.0, -3.0, 0.0};
  ball.friction = 0.4;
  scene.bodies.push_back(ball);
  return scene;
}

TEST_F(RefinedFiles, RestartedRunGoesOnBitForBit) {
  std::filesystem::create_directories(folder_);
  for (const mpm::Law law : {mpm::Law::kMonotone, mpm::Law::kDenseOnly}) {
    Scene scene = busy();
    scene.material.law = law;
    Simulation whole(scene, small_solver(1e-4)), first(scene, small_solver(1e-4));
    std::vector<std::vector<bool>> cuts;
    whole.add_observer([&](const mpm::StepView& view) { cuts.push_back(view.nodes->mesh.cut()); });
    run(whole, 40);
    EXPECT_NE(cuts.front(), cuts.back()) << "the same cells are cut throughout";
    run(first, 20);
    first.save(folder_ / "run.checkpoint");
    Simulation second(scene, small_solver(1e-4));
    second.restart(folder_ / "run.checkpoint");
    run(second, 20);
    EXPECT_EQ(whole.particles().position, second.particles().position);
    EXPECT_EQ(whole.particles().stress, second.particles().stress);
    EXPECT_EQ(whole.bodies()[0].centre_m, second.bodies()[0].centre_m);
    EXPECT_EQ(whole.summary().solves, second.summary().solves);
    EXPECT_EQ(whole.summary().iterations, second.summary().iterations);
  }
}

// Weights reproduce places: the nodes' solid is centred where the particles' is.
TEST_F(RefinedFiles, ExportedNodesAreWhereTheyAre) {
  Scene scene = busy();
  Particles before = particles_of(scene);
  Vector3d moment = Vector3d::Zero();
  for (std::size_t p = 0; p < before.count(); ++p) {
    moment += before.volume[p] * before.position[p];
  }
  Simulation simulation(scene, step_solver("auto", 1e-4));
  Eigen::VectorXd solid;
  simulation.add_observer([&](const mpm::StepView& view) { solid = view.nodes->solid; });
  mpm::Exporter exporter(folder_, engine::parse_selection("all"), simulation.scene());
  simulation.add_observer(std::ref(exporter));
  simulation.step();
  exporter.finish();
  const auto file = problems::read_problem_file(folder_ / (scene.name + "_000000.h5"));
  ASSERT_TRUE(file.geometry);
  const Vector3d of_nodes = file.geometry->points.topRows(solid.size()).transpose() * solid;
  EXPECT_LT((of_nodes - moment).norm(), 1e-13 * solid.sum());
}

}  // namespace
}  // namespace conebench::test
