#include "solvers/central_pair.h"

#include <gtest/gtest.h>

#include <random>

#include "solvers/nt_scaling.h"

namespace conebench::solvers {
namespace {

using Vector = Eigen::VectorXd;

// (sqrt(mu) r_n, r_t / sqrt(mu)) and (x_n / sqrt(mu), sqrt(mu) x_t).
Vector symmetric(double root_mu, Vector a) {
  a(0) *= root_mu;
  a.tail(a.size() - 1) /= root_mu;
  return a;
}

struct Pair {
  Vector r, x;
};

// Complementary: what a random z splits into.
Pair split(double mu, double lambda, const Vector& z) {
  Pair pair{z, {}};
  problems::project(mu, pair.r);
  pair.x = lambda * (pair.r - z);
  return pair;
}

TEST(CentralPair, LiesOnTheCentralPathOfItsCone) {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const double lambda = 3.0, nu = 0.02;
  for (const double mu : {0.05, 0.5, 1.0, 4.0}) {
    const double root = std::sqrt(mu);
    for (const int dim : {2, 3, 6}) {
      for (int draw = 0; draw < 50; ++draw) {
        const Vector z = Vector::NullaryExpr(dim, [&] { return normal(random); });
        Pair pair = split(mu, lambda, z);
        centre(mu, lambda, nu, pair.r, pair.x);
        EXPECT_GT(mu * pair.r(0), problems::tangential_norm(pair.r));
        EXPECT_GT(pair.x(0), mu * problems::tangential_norm(pair.x));
        const Vector product =
            jordan_product(symmetric(root, pair.r), symmetric(1.0 / root, pair.x));
        EXPECT_NEAR(product(0), nu, 1e-13);
        EXPECT_LE(product.tail(dim - 1).norm(), 1e-13);
      }
    }
  }
}

// lambda rho - xi is what it was: where nu is small, the pair hardly moves.
TEST(CentralPair, KeepsTheDifferenceOfItsSides) {
  const double mu = 0.6, lambda = 2.0, root = std::sqrt(mu);
  for (const Vector& z : {Vector(Eigen::Vector3d(1.0, 0.3, -0.2)),  // r inside, x = 0
                          Vector(Eigen::Vector3d(-1.0, 0.1, 0.2)),  // r = 0, x inside
                          Vector(Eigen::Vector3d(0.2, 0.9, -0.5)),  // both on the boundary
                          Vector(Eigen::Vector3d::Zero())}) {
    const Pair before = split(mu, lambda, z);
    for (const double nu : {1e-20, 1.0}) {
      Pair after = before;
      centre(mu, lambda, nu, after.r, after.x);
      const auto difference = [&](const Pair& pair) {
        return Vector(lambda * symmetric(root, pair.r) - symmetric(1.0 / root, pair.x));
      };
      EXPECT_LE((difference(after) - difference(before)).norm(), 1e-14);
      if (nu < 1e-10) {
        EXPECT_LE((after.r - before.r).norm() + (after.x - before.x).norm(), 1e-9);
      }
    }
  }
}

TEST(CentralPair, TreatsAHalfLineAsANumber) {
  for (const int dim : {1, 3}) {
    Vector r = Vector::Zero(dim), x = Vector::Constant(dim, 0.5);
    centre(0.0, 2.0, 0.25, r, x);
    EXPECT_NEAR(r(0) * x(0), 0.25, 1e-15);
    EXPECT_NEAR(2.0 * r(0) - x(0), -0.5, 1e-15);
    for (int k = 1; k < dim; ++k) {
      EXPECT_EQ(r(k), 0.0);
      EXPECT_EQ(x(k), 0.5);
    }
  }
}

}  // namespace
}  // namespace conebench::solvers
