#include "solvers/nt_scaling.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>

#include "problems/made_backwards.h"

namespace conebench::solvers {
namespace {

using problems::Problem;

// Pairs inside K_mu and its dual, as near to the boundary as `inside` says.
struct Pairs {
  Pairs(const Problem& problem, double inside) : r(problem.rows()), x(problem.rows()) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    for (double& value : r) value = uniform(random);
    for (double& value : x) value = uniform(random);
    for (int i = 0; i < problem.cone_count(); ++i) {
      const problems::Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
      const int at = problem.start(i);
      const double rt = r.segment(at + 1, cone.dim - 1).norm();
      const double xt = x.segment(at + 1, cone.dim - 1).norm();
      r(at) = (cone.mu > 0.0 ? rt / cone.mu : 0.0) + inside;
      x(at) = cone.mu * xt + inside;
      if (cone.mu == 0.0) r.segment(at + 1, cone.dim - 1).setZero();
    }
  }
  Eigen::VectorXd r, x;
};

Problem of_all_dimensions(double most_mu) {
  return problems::make_backwards({.cones = 40,
                                   .dims = {1, 2, 3, 4, 6},
                                   .mu_low = 0.5 * most_mu,
                                   .mu_high = most_mu,
                                   .seed = 3})
      .problem;
}

TEST(NtScalings, TakeBothSidesToTheSamePoint) {
  for (const auto& [most_mu, inside] : {std::pair{0.8, 1.0}, {0.8, 1e-6}, {0.0, 1.0}}) {
    const Problem problem = of_all_dimensions(most_mu);
    const Pairs pairs(problem, inside);
    NtScalings scalings(problem);
    scalings.set(pairs.r, pairs.x);
    BlockDiagonal R(problem);
    scalings.write_R(R);
    const Eigen::VectorXd lambda = scalings.lambda();
    const Eigen::VectorXd from_x = R * pairs.x, to_r = R.transpose_times(lambda);
    for (int i = 0; i < problem.cone_count(); ++i) {
      const int at = problem.start(i), size = scalings.size(i);
      const double scale = lambda.segment(at, size).norm() / inside;
      EXPECT_LE((from_x - lambda).segment(at, size).norm(), 1e-14 * scale) << i;
      EXPECT_LE((to_r - pairs.r).segment(at, size).norm(), 1e-14 * pairs.r.norm() / inside) << i;
      EXPECT_GT(lorentz_determinant(lambda.segment(at, size)), 0.0);
    }
    // The gap is that of the scaled point with itself.
    double gap = 0.0;
    for (int i = 0; i < problem.cone_count(); ++i) {
      const int at = problem.start(i), size = scalings.size(i);
      gap += pairs.r.segment(at, size).dot(pairs.x.segment(at, size));
    }
    EXPECT_NEAR(lambda.squaredNorm(), gap, 1e-12 * gap);
  }
}

TEST(NtScalings, OfAHalfLineIsARatio) {
  const Problem problem =
      problems::make_backwards({.cones = 3, .dims = {1}, .mu_low = 0.0, .mu_high = 0.0}).problem;
  NtScalings scalings(problem);
  scalings.set(Eigen::Vector3d(4.0, 1.0, 2.0), Eigen::Vector3d(9.0, 1.0, 8.0));
  BlockDiagonal R(problem);
  scalings.write_R(R);
  EXPECT_TRUE(scalings.lambda().isApprox(Eigen::Vector3d(6.0, 1.0, 4.0), 1e-15));
  EXPECT_NEAR(R[0](0, 0), std::sqrt(4.0 / 9.0), 1e-15);
  EXPECT_NEAR(R[2](0, 0), 0.5, 1e-15);
}

TEST(JordanAlgebra, DivisionUndoesTheProduct) {
  const Eigen::Vector3d a(2.0, 0.5, -1.2), b(-0.3, 1.0, 4.0);
  EXPECT_TRUE(jordan_divide(a, jordan_product(a, b)).isApprox(b, 1e-14));
  EXPECT_TRUE(jordan_product(a, jordan_divide(a, b)).isApprox(b, 1e-14));
  EXPECT_TRUE(jordan_product(a, b).isApprox(jordan_product(b, a), 1e-15));
  EXPECT_EQ(jordan_product(a, b)(0), a.dot(b));
}

TEST(LongestStep, EndsOnTheBoundary) {
  const Eigen::Vector3d inside(2.0, 0.5, -1.2);
  for (const Eigen::Vector3d& d : {Eigen::Vector3d(-1.0, 0.2, 0.3), Eigen::Vector3d(0.1, 1.0, -1.0),
                                   Eigen::Vector3d(-1.0, 0.0, 0.0)}) {
    const double step = longest_step(inside, d, 1e9);
    const Eigen::Vector3d end = inside + step * d;
    EXPECT_NEAR(end(0), end.tail(2).norm(), 1e-13);
    EXPECT_GT(end(0), 0.0);
    EXPECT_EQ(longest_step(inside, d, 0.5 * step), 0.5 * step);
  }
  EXPECT_EQ(longest_step(inside, Eigen::Vector3d(1.0, 0.3, 0.2), 7.0), 7.0);  // never leaves
}

}  // namespace
}  // namespace conebench::solvers
