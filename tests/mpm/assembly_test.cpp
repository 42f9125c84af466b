// The matrices and gaps of a step, against sums written out by hand here.

#include <gtest/gtest.h>

#include "tests/mpm/cloud_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using mpm::Particles;
using mpm::Scene;

class Assembly : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(In, Assembly, testing::Values(2, 3), dimension_name);

// H, row by row of stress and dof by dof, against sum_p V_p r(x_p) : D(v)(x_p).
template <int D>
void expect_strain_operator() {
  using Tensor = Eigen::Matrix<double, D, D>;
  const Scene scene = uneven(D, mpm::Condition::kFree);
  const Particles particles = cloud(scene, 400);
  const Posed posed = pose(scene, particles, 1e-3);
  const mpm::Grid& grid = scene.grid;
  Random random;
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<Tensor> r;
    std::vector<Vector3d> v;
    const Eigen::Index rows = posed.assembly.data.H.rows();
    Eigen::VectorXd rbar(rows), unknowns(posed.assembly.data.H.cols());
    for (int i = 0; i < posed.nodes.count(); ++i) {
      const Tensor a = random.matrix(D).template topLeftCorner<D, D>();
      r.push_back(a + a.transpose());
      rbar.segment<mpm::kEntries<D>>(i * mpm::kEntries<D>) = mpm::to_sym<D>(r.back());
      v.push_back(random.vector(D));
      for (std::size_t c = 0; c < D; ++c) {
        const int dof = posed.assembly.dof[static_cast<std::size_t>(i)][c];
        ASSERT_GE(dof, 0);
        unknowns[dof] = v.back()[static_cast<Eigen::Index>(c)];
      }
    }
    double power = 0.0, size = 0.0;
    for (std::size_t p = 0; p < particles.count(); ++p) {
      const Vector3d& x = particles.position[p];
      Tensor stress = Tensor::Zero(), gradient = Tensor::Zero();
      for (std::size_t i = 0; i < v.size(); ++i) {
        const int node = posed.nodes.index[i];
        stress += shape(grid, node, x) * r[i];
        gradient += v[i].head<D>() * shape_gradient(grid, node, x).head<D>().transpose();
      }
      const Tensor D_v = 0.5 * (gradient + gradient.transpose());
      power += particles.volume[p] * stress.cwiseProduct(D_v).sum();
      size += particles.volume[p] * stress.norm() * D_v.norm();
    }
    EXPECT_NEAR(rbar.dot(posed.assembly.data.H * unknowns), power, 1e-14 * size);
  }
}

TEST_P(Assembly, StrainOperatorIsThePowerOfStressOnStrainRate) {
  GetParam() == 2 ? expect_strain_operator<2>() : expect_strain_operator<3>();
}

void expect_no_stress_on_a_translation(const Posed& posed, int dim) {
  const auto& H = posed.assembly.data.H;
  for (int a = 0; a < dim; ++a) {
    Eigen::VectorXd v = Eigen::VectorXd::Zero(H.cols());
    for (const auto& dof : posed.assembly.dof) v[dof[static_cast<std::size_t>(a)]] = 1.0;
    EXPECT_LT((H * v).cwiseAbs().maxCoeff(), 1e-14 * H.norm()) << "along axis " << a;
  }
}

TEST_P(Assembly, NoStressActsOnATranslation) {
  const Scene scene = uneven(GetParam(), mpm::Condition::kFree);
  const Posed posed = pose(scene, cloud(scene, 400), 1e-3);
  expect_no_stress_on_a_translation(posed, GetParam());
}

// The same where particles sit on faces between cells, so that some nodes of their cell hold
// nothing and are left out.
TEST_P(Assembly, NoStressActsOnATranslationOfParticlesOnFaces) {
  Scene scene = open_scene(GetParam() == 2 ? std::vector{5, 5} : std::vector{5, 5, 5});
  // One particle a cell of a block that is shifted by half a cell.
  add_block(scene, Vector3d::Constant(0.5), Vector3d::Constant(3.5)).particles_per_cell = 1;
  const Posed posed = pose(scene, particles_of(scene), 1e-3);
  expect_no_stress_on_a_translation(posed, GetParam());
}

TEST_P(Assembly, GapIsWhatIsLeftOfTheLargestDensity) {
  const int dim = GetParam();
  Scene scene = box_scene(dim == 2 ? std::vector{6, 6} : std::vector{5, 5, 5});
  mpm::Block& dense = add_block(scene, Vector3d::Zero(), Vector3d::Constant(2.0));
  dense.particles_per_cell = 4;
  mpm::Block& loose = add_block(scene, Vector3d::Constant(2.0), Vector3d::Constant(4.25));
  loose.fraction = 0.35;
  const double h = 3e-3;
  const Posed posed = pose(scene, particles_of(scene), h);
  int full = 0;
  for (int i = 0; i < posed.nodes.count(); ++i) {
    const double volume = scene.grid.node_volume(posed.nodes.index[static_cast<std::size_t>(i)]);
    const double room = 0.6 * volume - posed.nodes.solid[i];
    const double gap = std::sqrt(2.0 / dim) * std::max(0.0, room) / h;
    EXPECT_NEAR(posed.assembly.law.gap[i], gap, 1e-12 * volume / h);
    EXPECT_NEAR(posed.assembly.law.density[i], posed.nodes.solid[i] / (0.6 * volume), 1e-14);
    full += gap <= 1e-12 * volume / h;
  }
  EXPECT_GE(full, 1);
  EXPECT_LT(full, posed.nodes.count());
}

// Compressing a node by its gap makes it dense: (B v)_0 h sqrt(d/2) is the volume that is lost.
TEST_P(Assembly, GapIsTheCompressionThatReachesTheLargestDensity) {
  const int dim = GetParam();
  Scene scene = open_scene(dim == 2 ? std::vector{4, 4} : std::vector{4, 4, 4});
  mpm::Block& block = add_block(scene, Vector3d::Zero(), Vector3d::Constant(4.0));
  block.fraction = 0.5;
  Particles particles = particles_of(scene);
  const double h = 1e-6;  // linearised: what is left over is of second order in h times strain rate
  const Vector3d centre = scene.grid.low_m + 0.5 * scene.grid.size_m;
  const double rate = -2.0;  // trace of the velocity gradient [1/s]
  for (std::size_t p = 0; p < particles.count(); ++p) {
    particles.velocity[p].head(dim) = rate / dim * (particles.position[p] - centre).head(dim);
    particles.affine[p].topLeftCorner(dim, dim).setIdentity();
    particles.affine[p] *= rate / dim;
  }
  scene.gravity_m_s2.setZero();
  const Posed before = pose(scene, particles, h);
  for (std::size_t p = 0; p < particles.count(); ++p) {
    particles.position[p] += h * particles.velocity[p];
  }
  const Posed after = pose(scene, particles, h);
  const int middle = before.nodes.slot_of[static_cast<std::size_t>(
      scene.grid.node(dim == 2 ? Eigen::Vector3i(2, 2, 0) : Eigen::Vector3i(2, 2, 2)))];
  const double lost = before.assembly.law.gap[middle] - after.assembly.law.gap[middle];
  EXPECT_NEAR(lost, -before.assembly.law.free_rate[middle], 1e-4 * lost);
}

}  // namespace
}  // namespace conebench::test
