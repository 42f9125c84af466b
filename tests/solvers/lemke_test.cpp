#include "solvers/lemke.h"

#include <gtest/gtest.h>

#include <random>

namespace conebench::solvers {
namespace {

const auto kForever = [](std::int64_t) { return true; };

Eigen::MatrixXd random_matrix(std::mt19937& random, Eigen::Index rows, Eigen::Index columns) {
  std::normal_distribution<double> normal;
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return normal(random); });
}

void expect_solution(const Eigen::MatrixXd& M, const Eigen::VectorXd& q, const Eigen::VectorXd& z,
                     double tol) {
  const Eigen::VectorXd w = M * z + q;
  EXPECT_GE(w.minCoeff(), -tol);
  EXPECT_GE(z.minCoeff(), 0.0);
  EXPECT_NEAR(w.dot(z), 0.0, tol * (1.0 + z.lpNorm<1>()));
}

// A positive definite M has one solution; that of M = [2 1; 1 2], q = (-5, -6) is (4/3, 7/3).
TEST(Lemke, SolvesATextbookExample) {
  const Eigen::Matrix2d M{{2.0, 1.0}, {1.0, 2.0}};
  Lemke lemke(M, Eigen::Vector2d(-5.0, -6.0));
  ASSERT_EQ(lemke.solve(kForever), LemkeEnd::kSolved);
  EXPECT_NEAR(lemke.z()(0), 4.0 / 3.0, 1e-14);
  EXPECT_NEAR(lemke.z()(1), 7.0 / 3.0, 1e-14);
}

TEST(Lemke, NeedsNoPivotWhereNothingIsViolated) {
  Lemke lemke(-Eigen::Matrix2d::Identity(), Eigen::Vector2d(0.0, 1.0));
  EXPECT_EQ(lemke.solve(kForever), LemkeEnd::kSolved);
  EXPECT_EQ(lemke.pivots(), 0);
  EXPECT_EQ(lemke.z().norm(), 0.0);
}

// The condition of M is about 1e4: rounding of 1e-16 times that, and of 100 pivots.
TEST(Lemke, SolvesRandomPositiveDefiniteAndSkewPlusSemidefiniteProblems) {
  std::mt19937 random(7);
  for (const Eigen::Index n : {1, 2, 5, 20, 60}) {
    for (int sample = 0; sample < 20; ++sample) {
      const Eigen::MatrixXd A = random_matrix(random, n, n), B = random_matrix(random, n, n);
      const Eigen::MatrixXd M = A * A.transpose() / static_cast<double>(n) + B - B.transpose() +
                                1e-2 * Eigen::MatrixXd::Identity(n, n);
      const Eigen::VectorXd q = random_matrix(random, n, 1);
      Lemke lemke(M, q);
      ASSERT_EQ(lemke.solve(kForever), LemkeEnd::kSolved) << n;
      expect_solution(M, q, lemke.z(), 1e-9);
    }
  }
}

// Every ratio is tied: q = -1 throughout and M = I + 1 1^T.
TEST(Lemke, BreaksTies) {
  for (const Eigen::Index n : {2, 7, 30}) {
    const Eigen::MatrixXd M = Eigen::MatrixXd::Identity(n, n) + Eigen::MatrixXd::Ones(n, n);
    const Eigen::VectorXd q = -Eigen::VectorXd::Ones(n);
    Lemke lemke(M, q);
    ASSERT_EQ(lemke.solve(kForever), LemkeEnd::kSolved);
    expect_solution(M, q, lemke.z(), 1e-12);
    EXPECT_LE(lemke.pivots(), 2 * n + 1);
  }
}

TEST(Lemke, EndsOnARayWhereThereIsNoSolution) {
  Lemke lemke(Eigen::Matrix2d::Zero(), Eigen::Vector2d(1.0, -1.0));
  EXPECT_EQ(lemke.solve(kForever), LemkeEnd::kRay);
}

TEST(Lemke, StopsWhenItIsTold) {
  Lemke lemke(Eigen::Matrix3d::Identity(), Eigen::Vector3d(-1.0, -2.0, -3.0));
  EXPECT_EQ(lemke.solve([](std::int64_t pivots) { return pivots < 2; }), LemkeEnd::kStopped);
  EXPECT_EQ(lemke.pivots(), 2);
}

}  // namespace
}  // namespace conebench::solvers
