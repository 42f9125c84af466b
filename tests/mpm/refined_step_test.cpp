// Steps on a grid that is refined at the heap's boundary: transfers, matrices, walls, bodies, runs.

#include <gtest/gtest.h>

#include <filesystem>

#include "mpm/viscosity.h"
#include "problems/problem_file.h"
#include "tests/engine/own_folder.h"
#include "tests/engine/small_solver.h"
#include "tests/mpm/cloud_helper.h"

namespace conebench::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using mpm::Nodes;
using mpm::Particles;
using mpm::Scene;
using mpm::Simulation;

// A dense block inside an open grid, disturbed, moving and turning: inside whole cells, outside
// halves, nodes that hang between them.
Scene heap(int dim) {
  Scene scene = open_scene(dim == 2 ? std::vector{9, 8} : std::vector{7, 7, 6});
  scene.grid.refine = mpm::Refine::kBoundary;
  scene.grid.low_m = flat(dim, {-0.3, 0.2, 1.0});
  for (int a = 0; a < dim; ++a) scene.grid.size_m[a] *= 1.0 + 0.3 * a;
  mpm::Block& block = add_block(scene, Vector3d::Constant(1.0), Vector3d::Constant(5.0));
  block.jitter = 0.5;
  return scene;
}

Particles moving(const Scene& scene) {
  Random random;
  Particles particles = particles_of(scene);
  for (std::size_t p = 0; p < particles.count(); ++p) {
    particles.velocity[p] = random.vector(scene.grid.dim);
    particles.affine[p] = 5.0 * random.matrix(scene.grid.dim);
  }
  return particles;
}

// Particles in whole cells and on halves beside them.
void expect_both_kinds(const Nodes& nodes) {
  int whole = 0, half = 0;
  for (const int node : nodes.index) {
    const Eigen::Vector3i at = nodes.mesh.grid().place(node);
    const bool corner = ((at[0] | at[1] | at[2]) & 1) == 0;
    const double full = nodes.mesh.grid().node_volume(node);
    whole += corner && nodes.mesh.node_volume(node) > 1.1 * full;
    half += !corner;
  }
  ASSERT_GT(whole, 0);
  ASSERT_GT(half, 0);
}

class Refined : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(In, Refined, testing::Values(2, 3), dimension_name);

// The angular momentum of a particle's affine part is sum_i N_i (x_i - x) x C (x_i - x).
template <int D>
void expect_transfer_keeps_momentum() {
  const Scene scene = heap(D);
  const Particles particles = moving(scene);
  Nodes nodes;
  mpm::scatter(scene, particles, nodes);
  expect_both_kinds(nodes);
  double volume = 0.0;
  Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
  for (std::size_t p = 0; p < particles.count(); ++p) {
    const double part = particles.volume[p];
    volume += part;
    linear += part * particles.velocity[p];
    angular += part * particles.position[p].cross(particles.velocity[p]);
    const auto s = mpm::stencil_at<D>(nodes.mesh, particles.position[p]);
    for (std::size_t k = 0; k < s.node.size(); ++k) {
      Vector3d reach = Vector3d::Zero();
      reach.template head<D>() = s.reach[k];
      angular += part * s.weight[k] * reach.cross(particles.affine[p] * reach);
    }
  }
  for (int i = 0; i < nodes.count(); ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const Vector3d momentum = nodes.solid[i] * nodes.velocity[slot];
    linear -= momentum;
    angular -= nodes.mesh.grid().position(nodes.index[slot]).cross(momentum);
  }
  EXPECT_NEAR(nodes.solid.sum(), volume, 1e-13 * volume);
  EXPECT_LT(linear.norm(), 1e-14 * volume);
  EXPECT_LT(angular.norm(), 1e-14 * volume);
}

TEST_P(Refined, TransferToTheGridKeepsMassMomentumAndAngularMomentum) {
  GetParam() == 2 ? expect_transfer_keeps_momentum<2>() : expect_transfer_keeps_momentum<3>();
}

TEST_P(Refined, TransferToTheParticlesKeepsMomentum) {
  const Scene scene = heap(GetParam());
  Particles particles = particles_of(scene);
  Nodes nodes;
  mpm::scatter(scene, particles, nodes);
  Random random;
  Vector3d momentum = Vector3d::Zero();
  for (int i = 0; i < nodes.count(); ++i) {
    Vector3d& v = nodes.velocity[static_cast<std::size_t>(i)];
    v = random.vector(GetParam());
    momentum += nodes.solid[i] * v;
  }
  const std::vector<Particles::Stress> stress(nodes.index.size(), Particles::Stress::Zero());
  mpm::gather(scene, nodes, nodes.velocity, stress, 0.0, particles);
  for (std::size_t p = 0; p < particles.count(); ++p) {
    momentum -= particles.volume[p] * particles.velocity[p];
  }
  EXPECT_LT(momentum.norm(), 1e-14 * nodes.solid.sum());
}

TEST_P(Refined, AffineVelocitiesGoToTheGridAndBackUnchanged) {
  const int dim = GetParam();
  const Scene scene = heap(dim);
  Particles particles = particles_of(scene);
  Random random;
  const Matrix3d A = random.matrix(dim);
  const Vector3d b = random.vector(dim);
  for (std::size_t p = 0; p < particles.count(); ++p) {
    particles.velocity[p] = A * particles.position[p] + b;
    particles.affine[p] = A;
  }
  Nodes nodes;
  mpm::scatter(scene, particles, nodes);
  for (int i = 0; i < nodes.count(); ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const Vector3d expected = A * nodes.mesh.grid().position(nodes.index[slot]) + b;
    EXPECT_LT((nodes.velocity[slot] - expected).norm(), 1e-13);
  }
  const Particles before = particles;
  const std::vector<Particles::Stress> stress(nodes.index.size(), Particles::Stress::Zero());
  mpm::gather(scene, nodes, nodes.velocity, stress, 0.01, particles);
  for (std::size_t p = 0; p < particles.count(); ++p) {
    EXPECT_LT((particles.velocity[p] - before.velocity[p]).norm(), 1e-13);
    EXPECT_LT((particles.affine[p] - A).norm(), 1e-12);
  }
}

// What the nodes' values make of a field at a point of the mesh.
template <int D>
struct Field {
  Eigen::Matrix<double, D, D> stress, gradient;
};
template <int D>
Field<D> field_at(const Nodes& nodes, const std::vector<Eigen::Matrix<double, D, D>>& stress,
                  const std::vector<Vector3d>& velocity, const Vector3d& x) {
  Field<D> field{Eigen::Matrix<double, D, D>::Zero(), Eigen::Matrix<double, D, D>::Zero()};
  const auto s = mpm::stencil_at<D>(nodes.mesh, x);
  for (std::size_t k = 0; k < s.node.size(); ++k) {
    const int slot = nodes.slot_of[static_cast<std::size_t>(s.node[k])];
    EXPECT_GE(slot, 0);
    field.stress += s.weight[k] * stress[static_cast<std::size_t>(slot)];
    field.gradient +=
        velocity[static_cast<std::size_t>(slot)].template head<D>() * s.gradient[k].transpose();
  }
  return field;
}

// H against sum_p V_p r(x_p) : D(v)(x_p), and the viscous form against 2 eta sum_p V_p |D(v)|^2.
template <int D>
void expect_power() {
  using Tensor = Eigen::Matrix<double, D, D>;
  Scene scene = heap(D);
  scene.material.viscosity_Pa_s = 0.7;
  const Particles particles = moving(scene);
  const Posed posed = pose(scene, particles, 1e-3);
  expect_both_kinds(posed.nodes);
  const auto& H = posed.assembly.data.H;
  Random random;
  std::vector<Tensor> r;
  std::vector<Vector3d> v;
  Eigen::VectorXd rbar(H.rows()), unknowns(H.cols());
  for (int i = 0; i < posed.nodes.count(); ++i) {
    const Tensor a = random.matrix(D).template topLeftCorner<D, D>();
    r.push_back(a + a.transpose());
    rbar.segment<mpm::kEntries<D>>(i * mpm::kEntries<D>) = mpm::to_sym<D>(r.back());
    v.push_back(random.vector(D));
    for (int c = 0; c < D; ++c) {
      const auto axis = static_cast<std::size_t>(c);
      unknowns[posed.assembly.dof[static_cast<std::size_t>(i)][axis]] = v.back()[c];
    }
  }
  double power = 0.0, viscous = 0.0, size = 0.0;
  for (std::size_t p = 0; p < particles.count(); ++p) {
    const Field<D> field = field_at<D>(posed.nodes, r, v, particles.position[p]);
    const Tensor D_v = 0.5 * (field.gradient + field.gradient.transpose());
    power += particles.volume[p] * field.stress.cwiseProduct(D_v).sum();
    viscous += particles.volume[p] * 2.0 * 0.7 * D_v.squaredNorm();
    size += particles.volume[p] * field.stress.norm() * D_v.norm();
  }
  EXPECT_NEAR(rbar.dot(H * unknowns), power, 1e-14 * size);
  const auto K = mpm::viscous_form(scene, particles, posed.nodes, posed.assembly.dof,
                                   static_cast<int>(H.cols()));
  EXPECT_NEAR(unknowns.dot(K * unknowns), viscous, 1e-12 * viscous);
}

TEST_P(Refined, StrainOperatorAndViscosityAreTheirPowers) {
  GetParam() == 2 ? expect_power<2>() : expect_power<3>();
}

// The part of a grid full of sand: a barrier in its middle, empty cells beyond, and walls.
Scene half_full(int dim) {
  Scene scene = open_scene(dim == 2 ? std::vector{6, 4} : std::vector{6, 4, 4});
  scene.grid.refine = mpm::Refine::kBoundary;
  add_block(scene, Vector3d::Zero(), flat(dim, {3.0, 4.0, 4.0}));
  return scene;
}

TEST_P(Refined, AreasOfAFrictionalWallAddUp) {
  const int dim = GetParam();
  Scene scene = half_full(dim);
  scene.walls[static_cast<std::size_t>(2 * dim - 2)] = {mpm::Condition::kFrictional, 0.3};
  const Posed posed = pose(scene, particles_of(scene), 1e-3);
  // Nodes at the end of the sand are half full: their fraction times their area is the area below.
  double area = 0.0;
  for (const mpm::Interface& contact : posed.assembly.interfaces) area += contact.weight / 0.6;
  EXPECT_NEAR(area, dim == 2 ? 0.3 : 0.12, 1e-14);
}

// A half space up to a quarter of a half above a plane of nodes: the midpoint rule is exact there.
TEST_P(Refined, BodiesCoverTheVolumeInsideThem) {
  const int dim = GetParam();
  Scene scene = open_scene(dim == 2 ? std::vector{4, 4} : std::vector{4, 4, 4});
  scene.grid.refine = mpm::Refine::kBoundary;
  add_block(scene, Vector3d::Zero(), flat(dim, {2.0, 4.0, 4.0}));
  add_block(scene, {2.0, 0.0, 0.0}, Vector3d::Constant(4.0)).fraction = 0.1;  // cut there
  mpm::Body ground;
  ground.shape = mpm::Shape::kHalfSpace;
  ground.normal = Vector3d::Unit(dim - 1);
  ground.centre_m = 0.1625 * ground.normal;
  const std::vector<mpm::RigidBody> bodies = {mpm::make_body(ground, dim)};
  Nodes nodes;
  mpm::scatter(scene, particles_of(scene), nodes);
  mpm::cover(scene, bodies, 0.0, nodes);
  const double volume = 0.1625 * (dim == 2 ? 0.4 : 0.16);
  EXPECT_NEAR(nodes.covered.sum(), volume, 1e-13 * volume);
}

TEST_P(Refined, NodesOnABarrierWithSandOnOneSideAreFull) {
  const int dim = GetParam();
  Scene scene = half_full(dim);
  mpm::Barrier barrier;
  barrier.position_m = 0.3;
  barrier.high_m = scene.grid.size_m;
  scene.barriers.push_back(barrier);
  const Posed posed = pose(scene, particles_of(scene), 1e-3);
  int on_barrier = 0;
  for (int i = 0; i < posed.nodes.count(); ++i) {
    const int node = posed.nodes.index[static_cast<std::size_t>(i)];
    const double x = posed.nodes.mesh.grid().position(node).x();
    EXPECT_NEAR(posed.assembly.law.density[i], 1.0, 1e-13) << "x = " << x;
    EXPECT_EQ(posed.assembly.dof[static_cast<std::size_t>(i)][0] < 0, std::abs(x - 0.3) < 1e-12);
    on_barrier += std::abs(x - 0.3) < 1e-12;
  }
  EXPECT_EQ(on_barrier, dim == 2 ? 9 : 81);
}

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
