// Steps on a grid that is refined at the heap's boundary: transfers, matrices, walls, bodies.

#include <gtest/gtest.h>

#include "mpm/viscosity.h"
#include "tests/mpm/cloud_helper.h"
#include "tests/mpm/refined_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using mpm::Nodes;
using mpm::Particles;
using mpm::Scene;

Particles moving(const Scene& scene) {
  Random random;
  Particles particles = particles_of(scene);
  for (std::size_t p = 0; p < particles.count(); ++p) {
    particles.velocity[p] = random.vector(scene.grid.dim);
    particles.affine[p] = 5.0 * random.matrix(scene.grid.dim);
  }
  return particles;
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
  const Scene scene = heap(GetParam());
  expect_affine_unchanged(scene, particles_of(scene));
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

}  // namespace
}  // namespace conebench::test
