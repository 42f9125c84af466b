#include "tests/mpm/cloud_helper.h"

#include <gtest/gtest.h>

namespace conebench::test {

using Eigen::Matrix3d;
using Eigen::Vector3d;

double Random::number(double low, double high) { return low + (high - low) * number_(random_); }

Vector3d Random::vector(int dim) {
  Vector3d x = Vector3d::Zero();
  for (int a = 0; a < dim; ++a) x[a] = number();
  return x;
}

Matrix3d Random::matrix(int dim) {
  Matrix3d a = Matrix3d::Zero();
  for (int k = 0; k < dim * dim; ++k) a(k / dim, k % dim) = number();
  return a;
}

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

mpm::Scene uneven(int dim, mpm::Condition walls) {
  mpm::Scene scene = open_scene(dim == 2 ? std::vector{5, 4} : std::vector{3, 4, 3});
  scene.grid.low_m = flat(dim, {-0.3, 0.2, 1.0});
  for (int a = 0; a < dim; ++a) scene.grid.size_m[a] *= 1.0 + 0.3 * a;
  for (mpm::Wall& wall : scene.walls) wall.condition = walls;
  return scene;
}

mpm::Particles cloud(const mpm::Scene& scene, std::size_t count) {
  Random random;
  mpm::Particles particles;
  const int dim = scene.grid.dim;
  for (std::size_t p = 0; p < count; ++p) {
    Vector3d x = scene.grid.low_m;
    for (int a = 0; a < dim; ++a) x[a] += scene.grid.size_m[a] * random.number(0.0, 1.0);
    particles.add(x, random.vector(dim), random.number(1e-4, 2e-4), 0.0);
    particles.affine.back() = 5.0 * random.matrix(dim);
  }
  return particles;
}

void expect_affine_unchanged(const mpm::Scene& scene, mpm::Particles particles) {
  Random random;
  const Matrix3d A = random.matrix(scene.grid.dim);
  const Vector3d b = random.vector(scene.grid.dim);
  for (std::size_t p = 0; p < particles.count(); ++p) {
    particles.velocity[p] = A * particles.position[p] + b;
    particles.affine[p] = A;
  }
  mpm::Nodes nodes;
  mpm::scatter(scene, particles, nodes);
  for (int i = 0; i < nodes.count(); ++i) {
    const auto slot = static_cast<std::size_t>(i);
    const Vector3d expected = A * nodes.mesh.grid().position(nodes.index[slot]) + b;
    EXPECT_LT((nodes.velocity[slot] - expected).norm(), 1e-13);
  }
  const mpm::Particles before = particles;
  const std::vector<mpm::Particles::Stress> stress(nodes.index.size(),
                                                   mpm::Particles::Stress::Zero());
  mpm::gather(scene, nodes, nodes.velocity, stress, 0.01, particles);
  for (std::size_t p = 0; p < particles.count(); ++p) {
    EXPECT_LT((particles.velocity[p] - before.velocity[p]).norm(), 1e-13);
    EXPECT_LT((particles.affine[p] - A).norm(), 1e-12);
    const Vector3d moved = before.position[p] + 0.01 * before.velocity[p];
    EXPECT_LT((particles.position[p] - moved).norm(), 1e-14);
  }
}

}  // namespace conebench::test
