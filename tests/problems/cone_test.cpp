#include "problems/cone.h"

#include <gtest/gtest.h>

#include <random>

namespace conebench::problems {
namespace {

Eigen::VectorXd random_vector(std::mt19937& random, int d) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd x(d);
  for (double& value : x) value = normal(random);
  return x;
}

Eigen::VectorXd projected(double mu, Eigen::VectorXd x) {
  project(mu, x);
  return x;
}

class Projection : public testing::TestWithParam<std::pair<int, double>> {};

TEST_P(Projection, IsIdempotentAndSplitsXIntoOrthogonalPartsOfTheConeAndItsPolar) {
  const auto [d, mu] = GetParam();
  std::mt19937 random(7);
  for (int k = 0; k < 500; ++k) {
    const Eigen::VectorXd x = random_vector(random, d), p = projected(mu, x), rest = p - x;
    EXPECT_LE((projected(mu, p) - p).norm(), 1e-15 * (1.0 + x.norm()));
    EXPECT_LE(tangential_norm(p), mu * p(0) + 1e-14);  // p in K
    EXPECT_GE(p(0), 0.0);
    EXPECT_LE(mu * tangential_norm(rest), rest(0) + 1e-14 * (1.0 + mu) * (1.0 + x.norm()));
    EXPECT_NEAR(p.dot(rest), 0.0, 1e-14 * (1.0 + mu) * x.squaredNorm());
  }
}

TEST_P(Projection, NeverLengthensADistance) {
  const auto [d, mu] = GetParam();
  std::mt19937 random(8);
  for (int k = 0; k < 500; ++k) {
    const Eigen::VectorXd x = random_vector(random, d), y = random_vector(random, d);
    EXPECT_LE((projected(mu, x) - projected(mu, y)).norm(), (x - y).norm() * (1.0 + 1e-14));
  }
}

INSTANTIATE_TEST_SUITE_P(DimensionsAndFriction, Projection,
                         testing::Values(std::pair{1, 0.0}, std::pair{1, 0.5}, std::pair{2, 0.3},
                                         std::pair{3, 0.0}, std::pair{3, 0.5}, std::pair{3, 3.0},
                                         std::pair{6, 0.7}, std::pair{9, 1.0}));

TEST(Projection, KnownPointsOfTheConeWithUnitFriction) {
  EXPECT_EQ(projected(1.0, Eigen::Vector2d(1.0, 1.0)), Eigen::Vector2d(1.0, 1.0));
  EXPECT_EQ(projected(1.0, Eigen::Vector2d(0.0, 2.0)), Eigen::Vector2d(1.0, 1.0));
  EXPECT_EQ(projected(1.0, Eigen::Vector2d(-2.0, 1.0)), Eigen::Vector2d(0.0, 0.0));
}

// mu = 0 is the half line x_n >= 0, x_t = 0; a negative x_n with x_t = 0 is not in it.
TEST(Projection, WithoutFrictionKeepsOnlyAPushingNormal) {
  EXPECT_EQ(projected(0.0, Eigen::Vector3d(-1.0, 0.0, 0.0)), Eigen::Vector3d::Zero());
  EXPECT_EQ(projected(0.0, Eigen::Vector3d(2.0, 3.0, 0.0)), Eigen::Vector3d(2.0, 0.0, 0.0));
}

TEST(DeSaxce, AddsThetaTimesTheSlidingSpeedToTheNormal) {
  Eigen::Vector3d u(-1.0, 3.0, 4.0);
  add_de_saxce(0.5, u);
  EXPECT_EQ(u, Eigen::Vector3d(1.5, 3.0, 4.0));
}

}  // namespace
}  // namespace conebench::problems
