#include "solvers/local/exact.h"

#include <gtest/gtest.h>

#include "harness/microbench/local_proof.h"
#include "harness/microbench/random_blocks.h"

namespace conebench::solvers {
namespace {

struct Tally {
  double worst = 0.0;
  int solved = 0, unsolvable = 0, unproved = 0;
};

template <int D>
Tally solve_random_blocks(int d, Conditioning kind, double mu, double theta, int count) {
  std::mt19937_64 random(static_cast<std::uint64_t>(d) * 100 + static_cast<std::uint64_t>(kind));
  Tally tally;
  for (int k = 0; k < count; ++k) {
    const Eigen::MatrixXd W = random_block(random, d, kind);
    const Eigen::VectorXd q = random_rate(random, W, kind);
    ExactLocal<D> local;
    local.set(W, largest_eigenvalue(W), mu, theta);
    typename ExactLocal<D>::Vector r = q;
    double a = 0.0;
    if (local.solve(q, r, a) == LocalCase::kNoSolution) {
      ++tally.unsolvable;
      if (!proved_unsolvable(W, q, mu)) ++tally.unproved;
      continue;
    }
    ++tally.solved;
    tally.worst = std::max(tally.worst, backward_residual(W, q, mu, theta, r));
  }
  return tally;
}

template <int D>
void expect_all_solved(int d, double theta_share) {
  for (const Conditioning kind :
       {Conditioning::kGood, Conditioning::kHard, Conditioning::kExtreme}) {
    for (const double mu : {0.1, 0.5, 3.0}) {
      const Tally tally = solve_random_blocks<D>(d, kind, mu, theta_share * mu, 3000);
      EXPECT_EQ(tally.unsolvable, 0) << "d " << d << " mu " << mu << " kind " << int(kind);
      EXPECT_LE(tally.worst, 1e-12) << "d " << d << " mu " << mu << " kind " << int(kind);
    }
  }
}

TEST(ExactLocal, SolvesEveryDefiniteCoulombBlock) {
  expect_all_solved<2>(2, 1.0);
  expect_all_solved<3>(3, 1.0);
  expect_all_solved<6>(6, 1.0);
  expect_all_solved<Eigen::Dynamic>(4, 1.0);
}

TEST(ExactLocal, SolvesEveryDefiniteBlockWithDilatancy) {
  for (const double share : {0.0, 0.5, 0.99}) {
    expect_all_solved<2>(2, share);
    expect_all_solved<3>(3, share);
    expect_all_solved<6>(6, share);
  }
}

TEST(ExactLocal, SolvesSingularBlocksOrIsProvedRightThatItCannot) {
  for (const double mu : {0.1, 0.5, 3.0}) {
    const Tally two = solve_random_blocks<2>(2, Conditioning::kSingular, mu, mu, 4000);
    const Tally three = solve_random_blocks<3>(3, Conditioning::kSingular, mu, mu, 4000);
    const Tally six = solve_random_blocks<6>(6, Conditioning::kSingular, mu, mu, 4000);
    for (const Tally& tally : {two, three, six}) {
      EXPECT_GT(tally.solved, 0);
      EXPECT_LE(tally.worst, 1e-12) << "mu " << mu;
      EXPECT_EQ(tally.unproved, 0) << "mu " << mu << " of " << tally.unsolvable;
    }
    EXPECT_GT(two.unsolvable + three.unsolvable + six.unsolvable, 0);
  }
}

// W = diag(W_nn, s I), as between spheres, has a closed form; turned away from it by 1e-13, not.
template <int D>
void expect_isotropic_solved(int d) {
  using Vector = typename ExactLocal<D>::Vector;
  std::mt19937_64 random(static_cast<std::uint64_t>(d));
  std::uniform_real_distribution<double> uniform(0.1, 2.0);
  int open = 0, sliding = 0, sticking = 0;
  for (int k = 0; k < 1000; ++k) {
    Eigen::MatrixXd W = uniform(random) * Eigen::MatrixXd::Identity(d, d);
    W(0, 0) = uniform(random);
    const Vector q = random_rate(random, W, Conditioning::kGood);
    const double lambda = largest_eigenvalue(W), mu = k % 10 == 0 ? 0.0 : uniform(random);
    ExactLocal<D> exact;
    exact.set(W, lambda, mu, mu);
    ASSERT_TRUE(exact.isotropic().has_value());
    Vector expected = q;
    double a = 0.0;
    const LocalCase found = exact.solve(q, expected, a);

    Vector r = Vector::Random(d);
    r(0) = std::abs(r(0));
    const Vector u = W * r + q;
    EXPECT_EQ(exact.isotropic()->solve(u, r), LocalOutcome::kDone);
    EXPECT_LE((r - expected).norm(), 1e-13 * (1.0 + q.norm()));
    EXPECT_LE(backward_residual(W, q, mu, mu, r), 1e-12);
    EXPECT_EQ(exact.isotropic()->stays_open(q(0)), found == LocalCase::kOpen);
    open += found == LocalCase::kOpen;
    sliding += found == LocalCase::kSlide;
    sticking += found == LocalCase::kStick;

    exact.set(W, lambda, mu, 0.5 * mu);
    EXPECT_EQ(exact.isotropic().has_value(), mu == 0.0);
    W(0, 1) += 1e-13;
    W(1, 0) += 1e-13;
    exact.set(W, lambda, mu, mu);
    EXPECT_FALSE(exact.isotropic().has_value());
  }
  EXPECT_GT(open, 50);
  EXPECT_GT(sliding, 50);
  EXPECT_GT(sticking, 50);
}

TEST(IsotropicCone, SolvesWhatTheGeneralOneDoes) {
  expect_isotropic_solved<2>(2);
  expect_isotropic_solved<3>(3);
  expect_isotropic_solved<6>(6);
  expect_isotropic_solved<Eigen::Dynamic>(4);
}

// So that a sweep sees it.
TEST(IsotropicCone, AnswersNaNWithNaN) {
  for (const int entry : {0, 1, 2}) {
    Eigen::Vector3d u(-1.0, 0.5, 0.2), r(1.0, 0.0, 0.0);
    u(entry) = std::numeric_limits<double>::quiet_NaN();
    IsotropicCone(1.0, 2.0, 0.5).solve(u, r);
    EXPECT_FALSE(r.allFinite()) << entry;
  }
}

TEST(IsotropicCone, IsNoneWhereWIsSingular) {
  ExactLocal<3> local;
  local.set(Eigen::Vector3d(1.0, 0.0, 0.0).asDiagonal(), 1.0, 0.5, 0.5);
  EXPECT_FALSE(local.isotropic().has_value());
  local.set(Eigen::Vector3d(0.0, 1.0, 1.0).asDiagonal(), 1.0, 0.5, 0.5);
  EXPECT_FALSE(local.isotropic().has_value());
}

// q_n just short of (mu - theta)|q_t|: a slide so small that rounding cannot tell it from opening.
TEST(ExactLocal, SolvesWhatIsOpenUpToRounding) {
  std::mt19937_64 random(3);
  for (const double short_by : {1e-17, 1e-16, 3e-16, 1e-15, 1e-12, 1e-6}) {
    for (int k = 0; k < 500; ++k) {
      const Eigen::Matrix3d W = random_block(random, 3, Conditioning::kGood);
      Eigen::Vector3d q = random_rate(random, W, Conditioning::kGood);
      q(0) = (0.5 - 0.1) * q.tail<2>().norm() * (1.0 - short_by);
      ExactLocal<3> local;
      local.set(W, largest_eigenvalue(W), 0.5, 0.1);
      Eigen::Vector3d r = Eigen::Vector3d::Ones();
      double a = 0.0;
      ASSERT_NE(local.solve(q, r, a), LocalCase::kNoSolution) << short_by;
      EXPECT_LE(backward_residual(W, q, 0.5, 0.1, r), 1e-12) << short_by;
    }
  }
}

// 2 kg block on a slope, one step of 0.01 s from rest: the closed form of a first course.
Eigen::Vector3d block_on_slope(double slope_rad, double mu, LocalCase& found) {
  ExactLocal<3> local;
  local.set(Eigen::Matrix3d::Identity() / 2.0, 0.5, mu, mu);
  const double kick = 9.81 * 0.01;
  Eigen::Vector3d r = Eigen::Vector3d::Zero();
  double a = 0.0;
  found = local.solve({-kick * std::cos(slope_rad), kick * std::sin(slope_rad), 0.0}, r, a);
  return r;
}

TEST(ExactLocal, BlockSticksBelowTheFrictionAngleAndSlidesAbove) {
  LocalCase found{};
  const double angle = std::atan(0.5);
  Eigen::Vector3d r = block_on_slope(angle - 1e-9, 0.5, found);
  EXPECT_EQ(found, LocalCase::kStick);
  r = block_on_slope(angle + 1e-9, 0.5, found);
  EXPECT_EQ(found, LocalCase::kSlide);
  r = block_on_slope(std::atan(1.0), 0.5, found);
  EXPECT_NEAR(r(0), 2.0 * 9.81 * 0.01 * std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(r(1), -0.5 * r(0), 1e-15);  // friction against the motion
}

TEST(ExactLocal, OpeningContactCarriesNothing) {
  ExactLocal<3> local;
  local.set(Eigen::Matrix3d::Identity(), 1.0, 0.3, 0.3);
  Eigen::Vector3d r(1.0, 2.0, 3.0);
  double a = 0.0;
  EXPECT_EQ(local.solve({1e-12, -5.0, 2.0}, r, a), LocalCase::kOpen);
  EXPECT_EQ(r.norm(), 0.0);
}

TEST(ExactLocal, FrictionlessContactTakesTheNormalOnly) {
  for (const double wn : {0.5, 4.0}) {
    ExactLocal<1> local;
    local.set(Eigen::Matrix<double, 1, 1>(wn), wn, 0.0, 0.0);
    Eigen::Matrix<double, 1, 1> r;
    double a = 0.0;
    local.solve(Eigen::Matrix<double, 1, 1>(-3.0), r, a);
    EXPECT_DOUBLE_EQ(r(0), 3.0 / wn);
  }
}

}  // namespace
}  // namespace conebench::solvers
