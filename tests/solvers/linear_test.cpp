#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>
#include <random>
#include <thread>

#include "problems/made_backwards.h"
#include "solvers/linear/cholesky.h"
#include "solvers/linear/gmres.h"
#include "solvers/linear/lu.h"
#include "solvers/linear/scaled_system.h"

namespace conebench::solvers {
namespace {

Eigen::MatrixXd random_matrix(int size, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Eigen::MatrixXd A(size, size);
  for (double& value : A.reshaped()) value = uniform(random);
  return A;
}

TEST(Gmres, SolvesWhatLuSolves) {
  const Eigen::MatrixXd A = random_matrix(40, 1) + 8.0 * Eigen::MatrixXd::Identity(40, 40);
  const Eigen::VectorXd b = random_matrix(40, 2).col(0);
  const auto apply = [&](const Eigen::VectorXd& x) { return Eigen::VectorXd(A * x); };
  const KrylovAnswer answer = gmres(apply, b, 1e-12, 40);
  EXPECT_LE((A * answer.x - b).norm(), 1e-12 * b.norm() * 1.1);
  EXPECT_LE((answer.x - A.lu().solve(b)).norm(), 1e-10 * b.norm());
  EXPECT_LT(gmres(apply, b, 1e-2, 40).iterations, answer.iterations);
}

TEST(Gmres, KeepsToItsLimitsAndTakesTheEasyCasesAtOnce) {
  const Eigen::MatrixXd A = random_matrix(40, 3);
  const Eigen::VectorXd b = random_matrix(40, 4).col(0);
  int products = 0;
  const auto apply = [&](const Eigen::VectorXd& x) {
    ++products;
    return Eigen::VectorXd(A * x);
  };
  EXPECT_EQ(gmres(apply, b, 1e-14, 5).iterations, 5);
  EXPECT_EQ(products, 5);
  EXPECT_LE((A * gmres(apply, b, 1e-14, 5).x - b).norm(), b.norm());
  const auto same = [](const Eigen::VectorXd& x) { return x; };
  EXPECT_EQ(gmres(same, b, 1e-14, 40).iterations, 1);
  EXPECT_TRUE(gmres(same, b, 1e-14, 40).x.isApprox(b, 1e-14));
  EXPECT_EQ(gmres(same, Eigen::VectorXd::Zero(3), 1e-14, 40).x, Eigen::VectorXd::Zero(3));
}

TEST(Cholesky, OfNothingSolvesNothing) {
  Cholesky cholesky;
  const Cholesky::Matrix empty(0, 0);
  cholesky.analyse(empty);
  EXPECT_TRUE(cholesky.factorize(empty));
  EXPECT_EQ(cholesky.solve(Eigen::VectorXd()).size(), 0);
}

// Only the lower triangle counts, whatever stands above it, in any order of the unknowns.
TEST(Cholesky, ReadsTheLowerTriangleOnly) {
  constexpr int kSize = 30;
  const Eigen::MatrixXd B = random_matrix(kSize, 5);
  const Eigen::MatrixXd A = B * B.transpose() + Eigen::MatrixXd::Identity(kSize, kSize);
  Eigen::MatrixXd stored = A;
  stored.triangularView<Eigen::StrictlyUpper>() = random_matrix(kSize, 6);
  const Cholesky::Matrix sparse = stored.sparseView();
  Cholesky cholesky;
  cholesky.analyse(sparse);
  ASSERT_TRUE(cholesky.factorize(sparse));
  const Eigen::VectorXd b = random_matrix(kSize, 7).col(0);
  EXPECT_LE((A * cholesky.solve(b) - b).norm(), 1e-10 * b.norm());
  ASSERT_TRUE(cholesky.factorize(Cholesky::Matrix(4.0 * sparse)));  // the analysis serves again
  EXPECT_LE((4.0 * A * cholesky.solve(b) - b).norm(), 1e-10 * b.norm());
  EXPECT_FALSE(cholesky.factorize(Cholesky::Matrix(-1.0 * sparse)));
}

// On either side of kSmall in solvers/linear/lu.cpp.
constexpr int kLuSizes[] = {1, 40, 400};

// Sparse, of symmetric pattern.
Lu::Matrix banded(int size, std::uint64_t seed, double diagonal) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  std::vector<Eigen::Triplet<double>> entries;
  for (int row = 0; row < size; ++row) {
    for (const int column : {row - 20, row - 1, row, row + 1, row + 20}) {
      if (column < 0 || column >= size) continue;
      entries.emplace_back(row, column, uniform(random) + (row == column ? diagonal : 0.0));
    }
  }
  Lu::Matrix A(size, size);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

TEST(Lu, SolvesAgainWithOtherValuesAfterOneAnalysis) {
  for (const int size : kLuSizes) {
    Lu lu;
    lu.analyse(banded(size, 1, 5.0));
    for (const std::uint64_t seed : {1, 2}) {
      const Lu::Matrix A = banded(size, seed, 5.0);
      ASSERT_TRUE(lu.factorize(A));
      const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(size, 1.0, 2.0);
      EXPECT_LE((A * lu.solve(b) - b).norm(), 1e-13 * b.norm()) << size;
      EXPECT_GT(lu.work_s(), 0.0);
    }
  }
}

TEST(Lu, OfNothingSolvesNothing) {
  Lu lu;
  const Lu::Matrix empty(0, 0);
  lu.analyse(empty);
  EXPECT_TRUE(lu.factorize(empty));
  EXPECT_EQ(lu.solve(Eigen::VectorXd()).size(), 0);
}

// Nothing on the diagonal: [0, A; I, 0].
TEST(Lu, FindsPivotsAwayFromTheDiagonal) {
  for (const int half : {20, 200}) {
    const Lu::Matrix A = banded(half, 3, 5.0);
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < half; ++j) {
      for (Lu::Matrix::InnerIterator it(A, j); it; ++it) {
        entries.emplace_back(it.row(), half + j, it.value());
      }
      entries.emplace_back(half + j, j, 1.0);
    }
    Lu::Matrix whole(2 * half, 2 * half);
    whole.setFromTriplets(entries.begin(), entries.end());
    Lu lu;
    lu.analyse(whole);
    ASSERT_TRUE(lu.factorize(whole));
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(2 * half, 1.0, 2.0);
    EXPECT_LE((whole * lu.solve(b) - b).norm(), 1e-12 * b.norm()) << half;
  }
}

TEST(Lu, SaysSoWhenAMatrixIsSingular) {
  for (const int size : kLuSizes) {
    Lu::Matrix A = banded(size, 4, 5.0);
    Lu lu;
    lu.analyse(A);
    for (int j = 0; j < size; ++j) {
      for (Lu::Matrix::InnerIterator it(A, j); it; ++it) {
        if (it.row() == size / 2) it.valueRef() = 0.0;
      }
    }
    EXPECT_FALSE(lu.factorize(A)) << size;
    const Lu::Matrix regular = banded(size, 4, 5.0);
    EXPECT_TRUE(lu.factorize(regular));  // and goes on
  }
}

// Whatever it says of such a matrix, it comes back, and serves the next one.
TEST(Lu, SurvivesNan) {
  for (const int size : kLuSizes) {
    const Lu::Matrix A = banded(size, 4, 5.0);
    Lu lu;
    lu.analyse(A);
    Lu::Matrix bad = A;
    bad.coeffRef(size / 2, size / 2) = std::numeric_limits<double>::quiet_NaN();
    lu.factorize(bad);
    ASSERT_TRUE(lu.factorize(A));
    const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(size, 1.0, 2.0);
    EXPECT_LE((A * lu.solve(b) - b).norm(), 1e-13 * b.norm()) << size;
  }
}

// No order has anything to choose: PORD, which MUMPS brings, ends the process here.
TEST(Lu, TakesADenseMatrix) {
  const int size = 1000;
  const Eigen::MatrixXd dense =
      random_matrix(size, 6) + 40.0 * Eigen::MatrixXd::Identity(size, size);
  const Lu::Matrix A = dense.sparseView();
  Lu lu;
  lu.analyse(A);
  ASSERT_TRUE(lu.factorize(A));
  const Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(size, 1.0, 2.0);
  EXPECT_LE((lu.solve(dense * x) - x).norm(), 1e-11 * x.norm());
}

TEST(Lu, ServesSeveralThreads) {
  const int size = 400;
  const Lu::Matrix A = banded(size, 5, 5.0);
  const Eigen::VectorXd b = Eigen::VectorXd::LinSpaced(size, 1.0, 2.0);
  const auto solved = [&] {
    Lu lu;
    lu.analyse(A);
    return lu.factorize(A) ? lu.solve(b) : Eigen::VectorXd();
  };
  const Eigen::VectorXd alone = solved();
  std::vector<Eigen::VectorXd> together(4);
  {
    std::vector<std::jthread> threads;
    for (Eigen::VectorXd& x : together) {
      threads.emplace_back([&] {
        for (int k = 0; k < 5; ++k) x = solved();
      });
    }
  }
  for (const Eigen::VectorXd& x : together) EXPECT_EQ(x, alone);
}

// (I + R C W R^T) y for random R and C_i = I + e_n c_i^T, or I.
struct System {
  System(const problems::Problem& of, bool symmetric) : problem(of), R(of), C(of) {
    std::uint64_t seed = 8;
    for (int i = 0; i < R.count(); ++i) {
      const auto dim = static_cast<int>(R[i].rows());
      R[i] = 30.0 / std::sqrt(problem.mobility()(i)) * random_matrix(dim, ++seed);
      C[i].setIdentity();
      if (symmetric) continue;
      C[i].row(0).tail(dim - 1) = 0.5 * random_matrix(dim, ++seed).row(0).tail(dim - 1);
    }
  }
  Eigen::VectorXd apply(const Eigen::VectorXd& y) const {
    return y + R * (C * problem.apply_delassus(R.transpose_times(y)));
  }

  const problems::Problem& problem;
  BlockDiagonal R, C;
};

TEST(ScaledSystem, EveryFormSolvesTheSameSystem) {
  for (const bool reduced : {false, true}) {
    const problems::Problem problem =
        problems::make_backwards({.cones = 30, .dims = {3, 2, 6, 1}, .reduced = reduced, .seed = 4})
            .problem;
    for (const bool symmetric : {false, true}) {
      const System system(problem, symmetric);
      const Eigen::VectorXd z = random_matrix(problem.rows(), 9).col(0);
      ScaledSystem scaled(problem, ScaledSystem::Form::kAuto, symmetric);
      const auto solves = [&] {
        ASSERT_TRUE(scaled.factorize(system.R, system.C));
        const double left = (system.apply(scaled.solve(z)) - z).norm() / z.norm();
        EXPECT_LE(left, 1e-9) << "reduced " << reduced << ", symmetric " << symmetric;
        EXPECT_LE(left, scaled.fine());
      };
      solves();
      ASSERT_EQ(scaled.can_be_finer(), !reduced);
      if (reduced) continue;
      scaled.be_finer();
      EXPECT_FALSE(scaled.can_be_finer());
      solves();
    }
  }
}

}  // namespace
}  // namespace conebench::solvers
