#pragma once

#include <random>

#include "tests/mpm/engine_helper.h"

namespace conebench::test {

/// Numbers evenly spread, the same in every run; entries beyond `dim` are 0.
class Random {
 public:
  double number(double low = -1.0, double high = 1.0);
  Eigen::Vector3d vector(int dim);
  Eigen::Matrix3d matrix(int dim);

 private:
  std::mt19937 random_{11};
  std::uniform_real_distribution<double> number_{0.0, 1.0};
};

/// The shape function of a node, as a product of tents, and its gradient.
double shape(const mpm::Grid& grid, int node, const Eigen::Vector3d& x);
Eigen::Vector3d shape_gradient(const mpm::Grid& grid, int node, const Eigen::Vector3d& x);

/// A grid with cells of three sizes, away from the origin.
mpm::Scene uneven(int dim, mpm::Condition walls);

/// Particles anywhere, with any velocity, affine part and volume.
mpm::Particles cloud(const mpm::Scene& scene, std::size_t count);

/// A velocity linear in place comes back from the grid as it was, and moves particles by itself.
void expect_affine_unchanged(const mpm::Scene& scene, mpm::Particles particles);

}  // namespace conebench::test
