// The viscous form, against the dissipated power summed over the particles.

#include <gtest/gtest.h>

#include "mpm/viscosity.h"
#include "tests/mpm/cloud_helper.h"

namespace conebench::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using mpm::Particles;
using mpm::Scene;

class Viscosity : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(In, Viscosity, testing::Values(2, 3), dimension_name);

TEST_P(Viscosity, ViscousFormIsTheDissipatedPower) {
  const int dim = GetParam();
  Scene scene = uneven(dim, mpm::Condition::kFree);
  scene.material.viscosity_Pa_s = 0.7;
  const Particles particles = cloud(scene, 200);
  const Posed posed = pose(scene, particles, 1e-3);
  const auto dofs = static_cast<int>(posed.assembly.data.M.rows());
  const auto K = mpm::viscous_form(scene, particles, posed.nodes, posed.assembly.dof, dofs);
  Random random;
  Eigen::VectorXd v(dofs);
  for (int i = 0; i < dofs; ++i) v[i] = random.number();
  double power = 0.0;
  for (std::size_t p = 0; p < particles.count(); ++p) {
    Matrix3d gradient = Matrix3d::Zero();
    for (std::size_t i = 0; i < posed.assembly.dof.size(); ++i) {
      const Vector3d g = shape_gradient(scene.grid, posed.nodes.index[i], particles.position[p]);
      for (int a = 0; a < dim; ++a) {
        const int dof = posed.assembly.dof[i][static_cast<std::size_t>(a)];
        gradient.row(a) += v[dof] * g.transpose();
      }
    }
    const Matrix3d D_v = 0.5 * (gradient + gradient.transpose());
    power += particles.volume[p] * 2.0 * 0.7 * D_v.squaredNorm();
  }
  EXPECT_NEAR(v.dot(K * v), power, 1e-12 * power);
  EXPECT_LT((K - problems::SparseMatrix(K.transpose())).norm(), 1e-14 * K.norm());
}

TEST_P(Viscosity, ViscosityIsInTheMassOrInTheFreeVelocityNotInBoth) {
  Scene scene = uneven(GetParam(), mpm::Condition::kFree);
  const Particles particles = cloud(scene, 200);
  const Posed dry = pose(scene, particles, 1e-2);
  scene.material.viscosity_Pa_s = 300.0;
  const Posed split = pose(scene, particles, 1e-2);
  scene.material.viscosity_in_mass = true;
  const Posed kept = pose(scene, particles, 1e-2);
  const auto& M = dry.assembly.data.M;
  EXPECT_EQ((split.assembly.data.M - M).norm(), 0.0);
  const auto K = mpm::viscous_form(scene, particles, kept.nodes, kept.assembly.dof,
                                   static_cast<int>(M.rows()));
  EXPECT_LT((kept.assembly.data.M - M - 1e-2 * K).norm(), 1e-14 * K.norm());
  // (M + h K) v* = M v: both start from the same v*, which differs from the dry one.
  const Eigen::VectorXd momentum = dry.assembly.data.f;
  const Eigen::VectorXd v = split.assembly.free_velocity;
  EXPECT_LT((kept.assembly.data.M * v - momentum).norm(), 1e-12 * momentum.norm());
  EXPECT_LT((kept.assembly.free_velocity - v).norm(), 1e-12 * v.norm());
  EXPECT_LT((kept.assembly.data.f - momentum).norm(), 1e-14 * momentum.norm());
  EXPECT_LT((split.assembly.data.f - M * v).norm(), 1e-14 * momentum.norm());
  EXPECT_GT((v - dry.assembly.free_velocity).norm(), 0.01 * v.norm());
}

}  // namespace
}  // namespace conebench::test
