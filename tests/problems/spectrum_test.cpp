#include "problems/spectrum.h"

#include <gtest/gtest.h>

#include <Eigen/SVD>

#include "problems/made_backwards.h"

namespace conebench::problems {
namespace {

SparseMatrix sparse(const Eigen::MatrixXd& dense) { return dense.sparseView(); }

// Frictionless contacts, one a row of H.
Problem with_rows(const Eigen::MatrixXd& M, const Eigen::MatrixXd& H) {
  return Problem(PrimalData{sparse(M), sparse(H), Eigen::VectorXd::Zero(M.rows()),
                            Eigen::VectorXd::Zero(H.rows())},
                 std::vector<Cone>(static_cast<std::size_t>(H.rows()), Cone::coulomb(1, 0.0)), {});
}

Problem with_delassus(const Eigen::MatrixXd& W) {
  return Problem(ReducedData{sparse(W), Eigen::VectorXd::Zero(W.rows())},
                 std::vector<Cone>(static_cast<std::size_t>(W.rows()), Cone::coulomb(1, 0.0)), {});
}

Eigen::MatrixXd identity(int size) { return Eigen::MatrixXd::Identity(size, size); }

void expect_spectrum(const Problem& problem, int rank, double condition, double relative_error) {
  const SpectrumAnswer answer = spectrum(problem);
  ASSERT_TRUE(answer.spectrum) << problem.name() << ": " << answer.reason;
  EXPECT_EQ(answer.spectrum->rank, rank) << problem.name();
  EXPECT_EQ(answer.spectrum->null_space, problem.rows() - rank) << problem.name();
  EXPECT_NEAR(answer.spectrum->condition, condition, relative_error * condition) << problem.name();
}

// Dense: the answer by definition.
void expect_that_of_svd(const Problem& problem) {
  const Eigen::MatrixXd W = problem.delassus();
  const Eigen::VectorXd values = Eigen::JacobiSVD<Eigen::MatrixXd>(W).singularValues();
  const int rank = static_cast<int>((values.array() > 1e-11 * values(0)).count());
  expect_spectrum(problem, rank, values(0) / values(rank - 1), 1e-3);
}

TEST(Spectrum, IdentityIsPerfect) {
  expect_spectrum(with_rows(identity(4), identity(4)), 4, 1.0, 1e-12);
  expect_spectrum(with_delassus(identity(5)), 5, 1.0, 1e-12);
}

TEST(Spectrum, DiagonalHasTheRatioOfItsEntries) {
  const Eigen::VectorXd masses = Eigen::VectorXd::LinSpaced(200, 1.0, 3000.0);
  expect_spectrum(with_rows(masses.asDiagonal(), identity(200)), 200, 3000.0, 1e-2);
  expect_spectrum(with_delassus(masses.asDiagonal()), 200, 3000.0, 1e-2);
}

TEST(Spectrum, RowsThatComeTwiceAreANullSpace) {
  Eigen::MatrixXd H(6, 4);
  H << identity(4), identity(4).topRows(2);
  expect_spectrum(with_rows(identity(4), H), 4, 2.0, 1e-12);
  expect_spectrum(with_delassus(H * H.transpose()), 4, 2.0, 1e-12);
}

TEST(Spectrum, FewRowsOnManyDofsHaveFullRank) {
  expect_spectrum(with_rows(identity(4), identity(4).topRows(2)), 2, 1.0, 1e-12);
}

TEST(Spectrum, NothingMovesWhereWIsZero) {
  expect_spectrum(with_rows(identity(3), Eigen::MatrixXd::Zero(2, 3)), 0, 1.0, 0.0);
  expect_spectrum(with_delassus(Eigen::MatrixXd::Zero(3, 3)), 0, 1.0, 0.0);
}

TEST(Spectrum, NoConesNoRank) {
  expect_spectrum(with_rows(identity(3), Eigen::MatrixXd(0, 3)), 0, 1.0, 0.0);
}

// Random H: its rank is the smaller of its sizes, unless rows were removed.
TEST(Spectrum, RanksOfTheFamiliesAreThoseOfTheirConstruction) {
  for (const bool reduced : {false, true}) {
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
      Recipe recipe{.cones = 24, .reduced = reduced, .seed = seed};
      const auto rank_of = [&](Family family) {
        recipe.family = family;
        const SpectrumAnswer answer = spectrum(make_backwards(recipe).problem);
        return answer.spectrum ? answer.spectrum->rank : -1;
      };
      EXPECT_EQ(rank_of(Family::kGeneric), 72);
      EXPECT_EQ(rank_of(Family::kRankDeficient), 36) << "six bodies";
      EXPECT_EQ(rank_of(Family::kSingularBlock), 64) << "every third cone lacks a row";
      EXPECT_EQ(rank_of(Family::kInfeasible), 60) << "every second normal row comes twice";
    }
  }
}

TEST(Spectrum, AgreesWithTheDenseDecomposition) {
  for (const Family family :
       {Family::kGeneric, Family::kRankDeficient, Family::kSingularBlock, Family::kInfeasible}) {
    for (const bool reduced : {false, true}) {
      for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        expect_that_of_svd(make_backwards({.family = family,
                                           .cones = 30,
                                           .dims = {3, 1, 6, 2},
                                           .mass_ratio = 100.0,
                                           .reduced = reduced,
                                           .seed = seed})
                               .problem);
      }
    }
  }
}

TEST(Spectrum, BothFormsAgree) {
  for (const Family family : {Family::kGeneric, Family::kRankDeficient, Family::kSeveral}) {
    Recipe recipe{.family = family, .cones = 100, .mass_ratio = 100.0, .seed = 4};
    const SpectrumAnswer primal = spectrum(make_backwards(recipe).problem);
    recipe.reduced = true;
    const SpectrumAnswer reduced = spectrum(make_backwards(recipe).problem);
    ASSERT_TRUE(primal.spectrum && reduced.spectrum);
    EXPECT_EQ(primal.spectrum->rank, reduced.spectrum->rank);
    EXPECT_NEAR(primal.spectrum->condition, reduced.spectrum->condition,
                0.01 * primal.spectrum->condition);
  }
}

TEST(Spectrum, IsNotComputedForLargeProblems) {
  const int rows = kLargestSpectrumRows + 1;
  SparseMatrix W(rows, rows);
  W.setIdentity();
  const Problem problem(ReducedData{W, Eigen::VectorXd::Zero(rows)},
                        std::vector<Cone>(static_cast<std::size_t>(rows), Cone::coulomb(1, 0.0)),
                        {});
  const SpectrumAnswer answer = spectrum(problem);
  EXPECT_FALSE(answer.spectrum);
  EXPECT_EQ(answer.reason, "more than 40000 rows");
}

}  // namespace
}  // namespace conebench::problems
