// Particles to grid and back, and the matrices of a step, against sums written out by hand here.

#include <gtest/gtest.h>

#include <random>

#include "mpm/viscosity.h"
#include "mpm/walls.h"
#include "tests/mpm/engine_helper.h"

namespace conebench::test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using mpm::Nodes;
using mpm::Particles;
using mpm::Scene;

constexpr double kDensity = 1500.0;

class Random {
 public:
  double number(double low = -1.0, double high = 1.0) {
    return low + (high - low) * number_(random_);
  }
  Vector3d vector(int dim) {
    Vector3d x = Vector3d::Zero();
    for (int a = 0; a < dim; ++a) x[a] = number();
    return x;
  }
  Matrix3d matrix(int dim) {
    Matrix3d a = Matrix3d::Zero();
    for (int k = 0; k < dim * dim; ++k) a(k / dim, k % dim) = number();
    return a;
  }

 private:
  std::mt19937 random_{11};
  std::uniform_real_distribution<double> number_{0.0, 1.0};
};

// The shape function of a node, as a product of tents, and its gradient.
double shape(const mpm::Grid& grid, int node, const Vector3d& x) {
  double value = 1.0;
  for (int a = 0; a < grid.dim; ++a) {
    const double cells = std::abs(x[a] - grid.position(node)[a]) / grid.spacing(a);
    value *= std::max(0.0, 1.0 - cells);
  }
  return value;
}

Vector3d shape_gradient(const mpm::Grid& grid, int node, const Vector3d& x) {
  Vector3d gradient = Vector3d::Zero();
  for (int a = 0; a < grid.dim; ++a) {
    const double cells = (x[a] - grid.position(node)[a]) / grid.spacing(a);
    if (std::abs(cells) >= 1.0) continue;
    gradient[a] = (cells > 0.0 ? -1.0 : 1.0) / grid.spacing(a);
    for (int b = 0; b < grid.dim; ++b) {
      const double other = std::abs(x[b] - grid.position(node)[b]) / grid.spacing(b);
      if (b != a) gradient[a] *= std::max(0.0, 1.0 - other);
    }
  }
  return gradient;
}

// A grid with cells of three sizes, away from the origin.
Scene uneven(int dim, mpm::Condition walls) {
  Scene scene = open_scene(dim == 2 ? std::vector{5, 4} : std::vector{3, 4, 3});
  scene.grid.low_m = flat(dim, {-0.3, 0.2, 1.0});
  for (int a = 0; a < dim; ++a) scene.grid.size_m[a] *= 1.0 + 0.3 * a;
  for (mpm::Wall& wall : scene.walls) wall.condition = walls;
  return scene;
}

// Particles anywhere, with any velocity, affine part and volume.
Particles cloud(const Scene& scene, std::size_t count) {
  Random random;
  Particles particles;
  const int dim = scene.grid.dim;
  for (std::size_t p = 0; p < count; ++p) {
    Vector3d x = scene.grid.low_m;
    for (int a = 0; a < dim; ++a) x[a] += scene.grid.size_m[a] * random.number(0.0, 1.0);
    particles.add(x, random.vector(dim), random.number(1e-4, 2e-4), 0.0);
    particles.affine.back() = 5.0 * random.matrix(dim);
  }
  return particles;
}

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
INSTANTIATE_TEST_SUITE_P(In, Transfer, testing::Values(2, 3), [](const auto& dimension) {
  return std::to_string(dimension.param) + "D";
});

template <int D>
void expect_shapes() {
  const Scene scene = uneven(D, mpm::Condition::kFree);
  const mpm::Grid& grid = scene.grid;
  constexpr double kStep = 1e-6;  // [m]; the functions are multilinear: only rounding is left
  for (const Vector3d& x : cloud(scene, 200).position) {
    const auto s = mpm::stencil_at<D>(grid, x);
    double sum = 0.0;
    mpm::Vec<D> gradients = mpm::Vec<D>::Zero(), reach = mpm::Vec<D>::Zero();
    for (std::size_t k = 0; k < s.node.size(); ++k) {
      EXPECT_NEAR(s.weight[k], shape(grid, s.node[k], x), 1e-13);
      const Vector3d reach_of_node = grid.position(s.node[k]) - x;
      EXPECT_LT((s.reach[k] - reach_of_node.template head<D>()).norm(), 1e-15);
      for (int a = 0; a < D; ++a) {
        const Vector3d e = kStep * Vector3d::Unit(a);
        const double slope =
            (shape(grid, s.node[k], x + e) - shape(grid, s.node[k], x - e)) / (2.0 * kStep);
        EXPECT_NEAR(s.gradient[k][a], slope, 1e-8);
      }
      sum += s.weight[k];
      gradients += s.gradient[k];
      reach += s.weight[k] * s.reach[k];
    }
    EXPECT_NEAR(sum, 1.0, 1e-15);
    EXPECT_LT(gradients.norm(), 1e-14 / grid.smallest_spacing());
    EXPECT_LT(reach.norm(), 1e-15);
  }
}

TEST(Shapes, SumToOneAndTheirGradientsAreTheirSlopes2D) { expect_shapes<2>(); }
TEST(Shapes, SumToOneAndTheirGradientsAreTheirSlopes3D) { expect_shapes<3>(); }

TEST_P(Transfer, GridsCornersAreInsideIt) {
  const Scene scene = uneven(GetParam(), mpm::Condition::kFree);
  const Vector3d high = scene.grid.low_m + scene.grid.size_m;
  ASSERT_TRUE(scene.grid.contains(high));
  const int last = scene.grid.node_count() - 1;
  if (GetParam() == 2) {
    EXPECT_EQ(mpm::stencil_at<2>(scene.grid, high).node.back(), last);
    EXPECT_NEAR(mpm::stencil_at<2>(scene.grid, high).weight.back(), 1.0, 1e-14);
  } else {
    EXPECT_EQ(mpm::stencil_at<3>(scene.grid, high).node.back(), last);
    EXPECT_NEAR(mpm::stencil_at<3>(scene.grid, high).weight.back(), 1.0, 1e-14);
  }
}

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
  const int dim = GetParam();
  const Scene scene = uneven(dim, mpm::Condition::kFree);
  Particles particles = cloud(scene, 300);
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
    const Vector3d expected = A * scene.grid.position(nodes.index[slot]) + b;
    EXPECT_LT((nodes.velocity[slot] - expected).norm(), 1e-13);
  }
  const Particles before = particles;
  const std::vector<Particles::Stress> stress(nodes.index.size(), Particles::Stress::Zero());
  mpm::gather(scene, nodes, nodes.velocity, stress, 0.01, particles);
  for (std::size_t p = 0; p < particles.count(); ++p) {
    EXPECT_LT((particles.velocity[p] - before.velocity[p]).norm(), 1e-13);
    EXPECT_LT((particles.affine[p] - A).norm(), 1e-12);
    const Vector3d moved = before.position[p] + 0.01 * before.velocity[p];
    EXPECT_LT((particles.position[p] - moved).norm(), 1e-14);
  }
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

TEST(StrainOperator, IsThePowerOfStressOnStrainRate2D) { expect_strain_operator<2>(); }
TEST(StrainOperator, IsThePowerOfStressOnStrainRate3D) { expect_strain_operator<3>(); }

TEST_P(Transfer, NoStressActsOnATranslation) {
  const Scene scene = uneven(GetParam(), mpm::Condition::kFree);
  const Posed posed = pose(scene, cloud(scene, 400), 1e-3);
  const auto& H = posed.assembly.data.H;
  for (int a = 0; a < GetParam(); ++a) {
    Eigen::VectorXd v = Eigen::VectorXd::Zero(H.cols());
    for (const auto& dof : posed.assembly.dof) v[dof[static_cast<std::size_t>(a)]] = 1.0;
    EXPECT_LT((H * v).cwiseAbs().maxCoeff(), 1e-14 * H.norm());
  }
}

// The same where particles sit on faces between cells, so that some nodes of their cell hold
// nothing and are left out.
TEST_P(Transfer, NoStressActsOnATranslationOfParticlesOnFaces) {
  Scene scene = open_scene(GetParam() == 2 ? std::vector{5, 5} : std::vector{5, 5, 5});
  // One particle a cell of a block that is shifted by half a cell.
  add_block(scene, Vector3d::Constant(0.5), Vector3d::Constant(3.5)).particles_per_cell = 1;
  const Posed posed = pose(scene, particles_of(scene), 1e-3);
  const auto& H = posed.assembly.data.H;
  for (int a = 0; a < GetParam(); ++a) {
    Eigen::VectorXd v = Eigen::VectorXd::Zero(H.cols());
    for (const auto& dof : posed.assembly.dof) v[dof[static_cast<std::size_t>(a)]] = 1.0;
    EXPECT_LT((H * v).cwiseAbs().maxCoeff(), 1e-14 * H.norm()) << "along axis " << a;
  }
}

TEST_P(Transfer, ViscousFormIsTheDissipatedPower) {
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

TEST_P(Transfer, ViscosityIsInTheMassOrInTheFreeVelocityNotInBoth) {
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

TEST_P(Transfer, GapIsWhatIsLeftOfTheLargestDensity) {
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
TEST_P(Transfer, GapIsTheCompressionThatReachesTheLargestDensity) {
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

TEST_P(Transfer, SlipWallsHoldTheNormalAndCarryNoShear) {
  const int dim = GetParam();
  const Scene scene = uneven(dim, mpm::Condition::kSlip);
  const Posed posed = pose(scene, cloud(scene, 400), 1e-3);
  const int entries = dim == 2 ? 3 : 6;
  // Shear rows of the components 12, 13, 23, and the axes they join.
  const std::vector<std::array<int, 3>> shears =
      dim == 2 ? std::vector<std::array<int, 3>>{{2, 0, 1}}
               : std::vector<std::array<int, 3>>{{3, 0, 1}, {4, 0, 2}, {5, 1, 2}};
  for (int i = 0; i < posed.nodes.count(); ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const Eigen::Vector3i at = scene.grid.place(posed.nodes.index[slot]);
    std::array<bool, 3> on_wall{};
    for (int a = 0; a < dim; ++a) {
      const auto axis = static_cast<std::size_t>(a);
      on_wall[axis] = at[a] == 0 || at[a] == scene.grid.cells[a];
      EXPECT_EQ(posed.assembly.dof[slot][axis] < 0, on_wall[axis]);
    }
    for (const auto& [row, a, b] : shears) {
      const double size = posed.assembly.data.H.row(i * entries + row).norm();
      const bool silent =
          on_wall[static_cast<std::size_t>(a)] || on_wall[static_cast<std::size_t>(b)];
      EXPECT_EQ(size == 0.0, silent) << "node " << at.transpose() << ", row " << row;
    }
    EXPECT_EQ(posed.assembly.cones[slot].dim, entries);
  }
}

TEST_P(Transfer, StickWallsHoldEverythingAndSilenceNothing) {
  const int dim = GetParam();
  const Scene scene = uneven(dim, mpm::Condition::kStick);
  const Posed posed = pose(scene, cloud(scene, 400), 1e-3);
  for (int i = 0; i < posed.nodes.count(); ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const Eigen::Vector3i at = scene.grid.place(posed.nodes.index[slot]);
    bool on_wall = false;
    for (int a = 0; a < dim; ++a) on_wall |= at[a] == 0 || at[a] == scene.grid.cells[a];
    for (int a = 0; a < dim; ++a) {
      EXPECT_EQ(posed.assembly.dof[slot][static_cast<std::size_t>(a)] < 0, on_wall);
    }
    for (int row = 0; row < (dim == 2 ? 3 : 6); ++row) {
      EXPECT_GT(posed.assembly.data.H.row(i * (dim == 2 ? 3 : 6) + row).norm(), 0.0);
    }
  }
}

TEST_P(Transfer, FrictionalWallsAddConesOverTheirArea) {
  const int dim = GetParam();
  Scene scene = open_scene(dim == 2 ? std::vector{4, 4} : std::vector{4, 4, 4});
  scene.walls[static_cast<std::size_t>(2 * dim - 2)] = {mpm::Condition::kFrictional, 0.3};
  add_block(scene, Vector3d::Zero(), Vector3d::Constant(4.0));
  const Posed posed = pose(scene, particles_of(scene), 1e-3);
  const auto& assembly = posed.assembly;
  double area = 0.0;
  for (std::size_t k = 0; k < assembly.interfaces.size(); ++k) {
    const mpm::Interface& contact = assembly.interfaces[k];
    const problems::Cone& cone = assembly.cones[static_cast<std::size_t>(posed.nodes.count()) + k];
    EXPECT_EQ(cone.dim, dim);
    EXPECT_EQ(cone.mu, 0.3);
    EXPECT_EQ(contact.frame.col(0), Vector3d::Unit(dim - 1));
    EXPECT_NEAR((contact.frame.transpose() * contact.frame - Matrix3d::Identity()).norm(), 0.0,
                1e-15);
    area += contact.weight / 0.6;
  }
  EXPECT_EQ(assembly.interfaces.size(), dim == 2 ? 5u : 25u);
  EXPECT_NEAR(area, dim == 2 ? 0.4 : 0.16, 1e-14);
}

// A half space up to a quarter of a cell above a plane of nodes: the midpoint rule is exact there.
TEST_P(Transfer, BodiesCoverTheVolumeInsideThem) {
  const int dim = GetParam();
  Scene scene = open_scene(dim == 2 ? std::vector{4, 4} : std::vector{4, 4, 4});
  add_block(scene, Vector3d::Zero(), Vector3d::Constant(4.0));
  mpm::Body floor;
  floor.shape = mpm::Shape::kHalfSpace;
  floor.normal = Vector3d::Unit(dim - 1);
  floor.centre_m = 0.125 * floor.normal;  // a quarter of the second cell
  const std::vector<mpm::RigidBody> bodies = {mpm::make_body(floor, dim)};
  const Particles particles = particles_of(scene);
  Nodes nodes;
  mpm::scatter(scene, particles, nodes);
  mpm::cover(scene, bodies, 0.0, nodes);
  for (int i = 0; i < nodes.count(); ++i) {
    const int layer = scene.grid.place(nodes.index[static_cast<std::size_t>(i)])[dim - 1];
    // Of a cell of length 1 above node `layer`: its tent from 0 to 1.25.
    const std::array<double, 5> covered = {0.5, 0.5 + 0.25 - 0.5 * 0.0625, 0.5 * 0.0625, 0.0, 0.0};
    const double full = layer == 0 || layer == 4 ? 0.5 : 1.0;
    const double share = covered[static_cast<std::size_t>(layer)] / full;
    EXPECT_NEAR(nodes.covered[i], share * nodes.volume[i], 1e-14) << layer;
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
