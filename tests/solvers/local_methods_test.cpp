// The local solvers beside `exact`, on random blocks.

#include <gtest/gtest.h>

#include "harness/microbench/local_proof.h"
#include "harness/microbench/random_blocks.h"
#include "solvers/local/exact.h"
#include "solvers/local/newton_ac.h"
#include "solvers/local/newton_fb.h"
#include "solvers/local/quartic.h"

namespace conebench::solvers {
namespace {

constexpr int kBlocks = 2000;
constexpr double kSolved = 1e-10;  // backward residual

struct Shares {
  double failed = 0.0;        ///< said that they failed
  double worst = 0.0;         ///< backward residual where they did not
  double disagreement = 0.0;  ///< |u - u_exact| / |q| there, largest
};

template <class Local>
void prepare(Local& local, const Eigen::MatrixXd& W, double mu, double theta) {
  local.set(W, largest_eigenvalue(W), mu, theta);
}

void prepare(QuarticLocal& local, const Eigen::MatrixXd& W, double mu, double) {
  local.set(W, largest_eigenvalue(W), mu);
}

// From r = 0, on the blocks of a kind.
template <class Local, int D>
Shares solve_blocks(Conditioning kind, double mu, double theta) {
  std::mt19937_64 random(static_cast<std::uint64_t>(D));
  Shares shares;
  for (int k = 0; k < kBlocks; ++k) {
    const Eigen::MatrixXd W = random_block(random, D, kind);
    const Eigen::VectorXd q = random_rate(random, W, kind);
    Local local;
    prepare(local, W, mu, theta);
    typename ExactLocal<D>::Vector r, exact_r;
    r.setZero();
    if (!local.solve(q, r)) {
      shares.failed += 1.0 / kBlocks;
      continue;
    }
    shares.worst = std::max(shares.worst, backward_residual(W, q, mu, theta, r));
    ExactLocal<D> exact;
    double a = 0.0;
    exact.set(W, largest_eigenvalue(W), mu, theta);
    exact.solve(q, exact_r, a);
    shares.disagreement = std::max(shares.disagreement, (W * (r - exact_r)).norm() / q.norm());
  }
  return shares;
}

// What the header's "no convergence proof" means in numbers: the largest share of failures seen on
// well conditioned blocks, and on blocks of condition 1e8.
struct Limits {
  double good, hard;
};

template <class Local, int D>
void expect_solved(double mu, double theta_share, const Limits& limits) {
  const double theta = theta_share * mu;
  const Shares good = solve_blocks<Local, D>(Conditioning::kGood, mu, theta);
  EXPECT_LE(good.failed, limits.good) << "d " << D << " mu " << mu << " theta " << theta;
  EXPECT_LE(good.worst, kSolved) << "d " << D << " mu " << mu << " theta " << theta;
  const Shares hard = solve_blocks<Local, D>(Conditioning::kHard, mu, theta);
  EXPECT_LE(hard.failed, limits.hard) << "d " << D << " mu " << mu << " theta " << theta;
  EXPECT_LE(hard.worst, kSolved) << "d " << D << " mu " << mu << " theta " << theta;
  // On well conditioned blocks with little friction the answer is unique.
  if (mu <= 0.1) {
    EXPECT_LE(good.disagreement, 1e-9);
  }
}

TEST(NewtonAcLocal, SolvesWellConditionedBlocksAndSaysWhenItFails) {
  expect_solved<NewtonAcLocal<2>, 2>(0.1, 1.0, {0.0, 0.02});
  expect_solved<NewtonAcLocal<3>, 3>(0.1, 1.0, {0.0, 0.06});
  expect_solved<NewtonAcLocal<6>, 6>(0.1, 1.0, {0.0, 0.08});
  expect_solved<NewtonAcLocal<3>, 3>(0.5, 1.0, {0.0, 0.2});
  expect_solved<NewtonAcLocal<3>, 3>(3.0, 1.0, {0.05, 0.25});
}

TEST(NewtonAcLocal, SolvesBlocksWithDilatancy) {
  expect_solved<NewtonAcLocal<3>, 3>(0.1, 0.5, {0.0, 0.08});
  expect_solved<NewtonAcLocal<3>, 3>(0.5, 0.5, {0.002, 0.3});
  expect_solved<NewtonAcLocal<6>, 6>(0.1, 0.0, {0.002, 0.15});
}

TEST(NewtonFbLocal, SolvesWellConditionedBlocksAndSaysWhenItFails) {
  expect_solved<NewtonFbLocal<2>, 2>(0.1, 1.0, {0.0, 0.01});
  expect_solved<NewtonFbLocal<3>, 3>(0.1, 1.0, {0.0, 0.01});
  expect_solved<NewtonFbLocal<6>, 6>(0.1, 1.0, {0.0, 0.01});
  expect_solved<NewtonFbLocal<3>, 3>(0.5, 1.0, {0.0, 0.05});
  expect_solved<NewtonFbLocal<3>, 3>(3.0, 1.0, {0.08, 0.25});
}

TEST(NewtonFbLocal, SolvesBlocksWithDilatancy) {
  expect_solved<NewtonFbLocal<3>, 3>(0.5, 0.5, {0.0, 0.05});
  expect_solved<NewtonFbLocal<3>, 3>(3.0, 0.0, {0.0, 0.2});
  expect_solved<NewtonFbLocal<6>, 6>(0.1, 0.0, {0.0, 0.02});
}

template <template <int> class Local>
void expect_solved_whatever_little_friction() {
  for (const double mu : {1e-3, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    expect_solved<Local<3>, 3>(mu, 1.0, {0.0, 0.0});
    expect_solved<Local<6>, 6>(mu, 0.0, {0.0, 0.0});
  }
}

TEST(LocalMethods, SolveBlocksOfTinyFriction) {
  expect_solved_whatever_little_friction<NewtonAcLocal>();
  expect_solved_whatever_little_friction<NewtonFbLocal>();
}

TEST(QuarticLocal, SolvesWellConditionedBlocksAndSaysWhenItFails) {
  for (const double mu : {0.1, 0.5, 3.0}) expect_solved<QuarticLocal, 3>(mu, 1.0, {0.0, 0.01});
}

TEST(QuarticLocal, SlidesAsTheClosedFormOfABlockOnASlope) {
  QuarticLocal local;
  local.set(Eigen::Matrix3d::Identity() / 2.0, 0.5, 0.5);
  const double kick = 9.81 * 0.01 * std::sqrt(0.5);
  Eigen::Vector3d r;
  ASSERT_TRUE(local.solve({-kick, kick, 0.0}, r));
  EXPECT_NEAR(r(0), 2.0 * kick, 1e-15);
  EXPECT_NEAR(r(1), -0.5 * r(0), 1e-15);
}

template <class Local>
void expect_frictionless_closed_form() {
  Local local;
  Eigen::Matrix3d W = Eigen::Matrix3d::Identity();
  W(0, 1) = W(1, 0) = 0.5;
  prepare(local, W, 0.0, 0.0);
  Eigen::Vector3d r(1.0, 1.0, 1.0);
  EXPECT_TRUE(local.solve({-3.0, 1.0, 2.0}, r));
  EXPECT_EQ(r, Eigen::Vector3d(3.0, 0.0, 0.0));
  EXPECT_TRUE(local.solve({3.0, 1.0, 2.0}, r));
  EXPECT_EQ(r.norm(), 0.0);
}

TEST(LocalMethods, TakeTheNormalOnlyWithoutFriction) {
  expect_frictionless_closed_form<NewtonAcLocal<3>>();
  expect_frictionless_closed_form<NewtonFbLocal<3>>();
  expect_frictionless_closed_form<QuarticLocal>();
}

}  // namespace
}  // namespace conebench::solvers
