// Particles to grid and back, against sums written out by hand here.

#include <gtest/gtest.h>

#include "tests/mpm/cloud_helper.h"

namespace conebench::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using mpm::Nodes;
using mpm::Particles;
using mpm::Scene;

constexpr double kDensity = 1500.0;

// Angular momentum of particles, the affine part included: sum_i N_i (x_i - x)(x_i - x)^T is
// diagonal, with s (1 - s) l^2 for the place s in the cell.
Vector3d angular_momentum(const Scene& scene, const Particles& particles) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t p = 0; p < particles.count(); ++p) {
    const double m = kDensity * particles.volume[p];
    const Vector3d& x = particles.position[p];
    Matrix3d spread = Matrix3d::Zero();
    for (int a = 0; a < scene.grid.dim; ++a) {
      const double l = scene.grid.spacing(a), place = (x[a] - scene.grid.low_m[a]) / l;
      const double s = place - std::floor(place);
      spread(a, a) = s * (1.0 - s) * l * l;
    }
    const Matrix3d moment = spread * particles.affine[p].transpose();  // sum N_i (x_i - x) dv_i^T
    sum += m * x.cross(particles.velocity[p]);
    sum += m * Vector3d(moment(1, 2) - moment(2, 1), moment(2, 0) - moment(0, 2),
                        moment(0, 1) - moment(1, 0));
  }
  return sum;
}

Vector3d momentum(const Particles& particles) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t p = 0; p < particles.count(); ++p) {
    sum += kDensity * particles.volume[p] * particles.velocity[p];
  }
  return sum;
}

struct GridMomentum {
  Vector3d linear = Vector3d::Zero(), angular = Vector3d::Zero();
};
GridMomentum grid_momentum(const Scene& scene, const Nodes& nodes) {
  GridMomentum sum;
  for (int i = 0; i < nodes.count(); ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const Vector3d p = kDensity * nodes.solid[i] * nodes.velocity[slot];
    sum.linear += p;
    sum.angular += scene.grid.position(nodes.index[slot]).cross(p);
  }
  return sum;
}

class Transfer : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(In, Transfer, testing::Values(2, 3), dimension_name);

TEST_P(Transfer, ToTheGridKeepsMassMomentumAndAngularMomentum) {
  const Scene scene = uneven(GetParam(), mpm::Condition::kFree);
  const Particles particles = cloud(scene, 300);
  Nodes nodes;
  mpm::scatter(scene, particles, nodes);
  double volume = 0.0;
  for (const double part : particles.volume) volume += part;
  EXPECT_NEAR(nodes.solid.sum(), volume, 1e-13 * volume);
  const GridMomentum grid = grid_momentum(scene, nodes);
  const double mass = kDensity * volume;  // about 1 m and 1 m/s, rounding of 300 terms
  EXPECT_LT((grid.linear - momentum(particles)).norm(), 1e-14 * mass);
  EXPECT_LT((grid.angular - angular_momentum(scene, particles)).norm(), 1e-14 * mass);
}

// The affine part carries angular momentum as sum_i N_i (x_i - x_p) x dv_i where the particle was
// when the grid gave it; the advection that follows is not part of the transfer (h = 0 here).
TEST_P(Transfer, ToTheParticlesKeepsMomentumAndAngularMomentum) {
  const Scene scene = uneven(GetParam(), mpm::Condition::kFree);
  Particles particles = cloud(scene, 300);
  Nodes nodes;
  mpm::scatter(scene, particles, nodes);
  Random random;
  for (Vector3d& v : nodes.velocity) v = random.vector(GetParam());
  const std::vector<Particles::Stress> stress(nodes.index.size(), Particles::Stress::Zero());
  mpm::gather(scene, nodes, nodes.velocity, stress, 0.0, particles);
  const GridMomentum grid = grid_momentum(scene, nodes);
  const double mass = kDensity * nodes.solid.sum();
  EXPECT_LT((grid.linear - momentum(particles)).norm(), 1e-14 * mass);
  EXPECT_LT((grid.angular - angular_momentum(scene, particles)).norm(), 1e-14 * mass);
}

TEST_P(Transfer, AffineVelocitiesGoToTheGridAndBackUnchanged) {
  const Scene scene = uneven(GetParam(), mpm::Condition::kFree);
  expect_affine_unchanged(scene, cloud(scene, 300));
}

TEST_P(Transfer, ActiveNodesAreThoseThatParticlesReach) {
  const Scene scene = uneven(GetParam(), mpm::Condition::kFree);
  const Particles particles = cloud(scene, 7);
  Nodes nodes;
  mpm::scatter(scene, particles, nodes);
  for (int node = 0; node < scene.grid.node_count(); ++node) {
    double solid = 0.0;
    for (std::size_t p = 0; p < particles.count(); ++p) {
      solid += particles.volume[p] * shape(scene.grid, node, particles.position[p]);
    }
    const int slot = nodes.slot_of[static_cast<std::size_t>(node)];
    ASSERT_EQ(slot >= 0, solid > 1e-9 * scene.grid.node_volume(node));
    if (slot < 0) continue;
    EXPECT_NEAR(nodes.solid[slot], solid, 1e-12 * solid);
  }
}

TEST_P(Transfer, FrictionRisesWithTheInertialNumber) {
  Scene scene = uneven(GetParam(), mpm::Condition::kFree);
  scene.material.friction_rise = 0.25;
  scene.material.grain_diameter_m = 1e-3;
  Particles particles = cloud(scene, 100);
  for (double& I : particles.inertial_number) I = 0.6;
  Nodes nodes;
  mpm::scatter(scene, particles, nodes);
  for (int i = 0; i < nodes.count(); ++i) {
    EXPECT_NEAR(nodes.friction[i], 0.4 + 0.25 / (1.0 + 0.3 / 0.6), 1e-14);
  }
}

}  // namespace
}  // namespace conebench::test
