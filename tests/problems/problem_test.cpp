#include "problems/problem.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "problems/error.h"
#include "problems/made_backwards.h"

namespace conebench::problems {
namespace {

SparseMatrix sparse(const Eigen::MatrixXd& dense) { return dense.sparseView(); }

Metadata named(std::string name) {
  Metadata metadata;
  metadata.name = std::move(name);
  return metadata;
}

Problem block(const Eigen::Matrix3d& M, const Eigen::Vector3d& f, Cone cone) {
  return Problem(
      PrimalData{sparse(M), sparse(Eigen::Matrix3d::Identity()), f, Eigen::Vector3d::Zero()},
      {cone}, named("block"));
}

std::string error_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

// An island is not checked again: it must be what the constructor would have made of its parts.
void expect_as_built_anew(const Problem& part) {
  std::vector<Cone> cones(part.cones().begin(), part.cones().end());
  const Problem anew =
      part.is_primal()
          ? Problem(PrimalData{part.M(), part.H(), part.f(), part.w()}, cones, part.metadata(),
                    part.rate_scale())
          : Problem(ReducedData{part.W(), part.q()}, cones, part.metadata(), part.rate_scale());
  EXPECT_EQ(part.rows(), anew.rows());
  EXPECT_EQ(part.mobility(), anew.mobility());
  EXPECT_LE((part.q() - anew.q()).norm(), 1e-14 * anew.q().norm());
  if (!part.is_primal()) return;
  EXPECT_EQ(part.inertia().component_count(), anew.inertia().component_count());
  EXPECT_TRUE(std::ranges::equal(part.inertia().component_of(), anew.inertia().component_of()));
  EXPECT_EQ(Eigen::MatrixXd(part.inertia().inverse_root()),
            Eigen::MatrixXd(anew.inertia().inverse_root()));
}

TEST(Problem, NamesWhatIsWrongInItsData) {
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  const Eigen::Vector3d f(1.0, 2.0, 3.0);
  using testing::HasSubstr;
  EXPECT_THAT(error_of([&] { block(I, f, Cone::coulomb(3, -0.5)); }),
              HasSubstr("block: cone 0 has mu -0.5, expected finite and >= 0"));
  EXPECT_THAT(error_of([&] { block(I, f, Cone{3, 0.5, 0.0, 0.6}); }), HasSubstr("theta 0.6"));
  EXPECT_THAT(error_of([&] { block(I, f, Cone::coulomb(3, 0.5, -1.0)); }), HasSubstr("kappa -1"));
  EXPECT_THAT(error_of([&] { block(I, f, Cone::coulomb(2, 0.5)); }),
              HasSubstr("H is 3 x 3, expected 2 x 3"));
  EXPECT_THAT(error_of([&] { block(-I, f, Cone::coulomb(3, 0.5)); }),
              HasSubstr("M is not positive definite"));
  EXPECT_THAT(error_of([&] {
                block(I, {1.0, NAN, 3.0}, Cone::coulomb(3, 0.5));
              }),
              HasSubstr("f[1] is nan"));
  Eigen::Matrix3d skew = I;
  skew(0, 1) = 0.1;
  EXPECT_THAT(error_of([&] { block(skew, f, Cone::coulomb(3, 0.5)); }),
              HasSubstr("expected M symmetric"));
  EXPECT_THAT(error_of([&] {
                Problem(ReducedData{sparse(skew * 10.0 - 9.0 * I), f}, {Cone::coulomb(3, 0.5)}, {});
              }),
              HasSubstr("|W - W^T| / |W|"));
}

TEST(Problem, WithoutConesIsSound) {
  const Problem empty(
      PrimalData{SparseMatrix(0, 0), SparseMatrix(0, 0), Eigen::VectorXd(0), Eigen::VectorXd(0)},
      {}, {});
  EXPECT_EQ(empty.rows(), 0);
  EXPECT_EQ(empty.islands().size(), 0u);
  EXPECT_EQ(empty.rate_scale(), 0.0);
}

TEST(Problem, RateIsTheSameInBothFormsAndThroughDelassus) {
  const Recipe recipe{.cones = 15, .dims = {3, 2, 1, 6}, .cohesive_share = 0.5, .seed = 3};
  Recipe reduced_recipe = recipe;
  reduced_recipe.reduced = true;
  const Problem primal = make_backwards(recipe).problem;
  const Problem reduced = make_backwards(reduced_recipe).problem;
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(primal.rows(), -1.0, 2.0);
  EXPECT_LE((primal.rate(r) - reduced.rate(r)).norm(), 1e-12 * primal.rate(r).norm());
  EXPECT_LE((primal.apply_delassus(r) - primal.delassus() * r).norm(), 1e-12 * r.norm());
  EXPECT_LE((primal.M() * primal.velocity(r) - primal.f() - primal.H().transpose() * r).norm(),
            1e-12 * r.norm());
  EXPECT_LE((primal.mobility() - reduced.mobility()).norm(), 1e-12 * primal.mobility().norm());
}

// M that couples all dofs takes the sparse Cholesky; the answer must be that of a dense solve.
TEST(Problem, CoupledMassIsSolvedExactly) {
  const int n = 40;
  Eigen::MatrixXd M = 3.0 * Eigen::MatrixXd::Identity(n, n);
  for (int i = 0; i + 1 < n; ++i) M(i, i + 1) = M(i + 1, i) = -1.0;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(6, n);
  for (int row = 0; row < 6; ++row) H(row, 5 * row) = 1.0 + row;
  const Eigen::VectorXd f = Eigen::VectorXd::LinSpaced(n, -1.0, 1.0);
  const Problem problem(PrimalData{sparse(M), sparse(H), f, Eigen::VectorXd::Zero(6)},
                        {Cone::coulomb(3, 0.5), Cone::coulomb(3, 0.5)}, {});
  EXPECT_FALSE(problem.inertia().block_diagonal());
  const Eigen::MatrixXd W = H * M.ldlt().solve(H.transpose());
  EXPECT_LE((Eigen::MatrixXd(problem.delassus()) - W).norm(), 1e-13 * W.norm());
  EXPECT_LE((problem.q() - H * M.ldlt().solve(f)).norm(), 1e-13);
  // lambda uses the diagonal of M there.
  EXPECT_NEAR(problem.mobility()(1), 36.0 / 3.0, 1e-13);
}

TEST(Problem, ShiftMovesTheTipAndKeepsRatesAndScale) {
  const Problem problem =
      make_backwards({.cones = 12, .dims = {3, 6}, .cohesive_share = 1.0, .seed = 4}).problem;
  const Problem standard = problem.shifted();
  EXPECT_TRUE(standard.is_standard());
  EXPECT_FALSE(problem.is_standard());
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(problem.rows(), -1.0, 2.0);
  EXPECT_LE((standard.rate(r + problem.tip_shift()) - problem.rate(r)).norm(), 1e-12);
  EXPECT_EQ(standard.rate_scale(), problem.rate_scale());
  EXPECT_TRUE(problem.rate_scale_is_of_data());
  EXPECT_FALSE(standard.rate_scale_is_of_data());
}

// Formulation 2 by hand: one unit mass pushed into the ground at 3 m/s, mu = 0, kappa = 2 N s.
TEST(Problem, RateScaleIsTheViolationAtRestOrThePullOfCohesion) {
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  EXPECT_DOUBLE_EQ(block(I, {-3.0, 0.0, 0.0}, Cone::coulomb(3, 0.0)).rate_scale(), 3.0);
  // Opening at 5 m/s against a pull of 2: the pull is what must be resisted.
  EXPECT_DOUBLE_EQ(block(I, {5.0, 0.0, 0.0}, Cone::coulomb(3, 0.5, 2.0)).rate_scale(), 2.0);
  // Opening without cohesion: nothing is violated; the floor 1e-6 |q| remains.
  EXPECT_DOUBLE_EQ(block(I, {5.0, 0.0, 0.0}, Cone::coulomb(3, 0.5)).rate_scale(), 5e-6);
}

TEST(Problem, IslandsPartitionTheConesAndKeepTheirRates) {
  Recipe recipe{.cones = 8, .dims = {3, 2}, .seed = 5};
  const Problem whole = make_backwards(recipe).problem;
  // Two copies side by side on separate bodies.
  auto twice = [](const SparseMatrix& A) {
    Eigen::MatrixXd D = Eigen::MatrixXd::Zero(2 * A.rows(), 2 * A.cols());
    D.topLeftCorner(A.rows(), A.cols()) = A;
    D.bottomRightCorner(A.rows(), A.cols()) = A;
    return sparse(D);
  };
  auto stacked = [](const Eigen::VectorXd& x) {
    Eigen::VectorXd y(2 * x.size());
    y << x, x;
    return y;
  };
  std::vector<Cone> cones(whole.cones().begin(), whole.cones().end());
  const std::size_t single = cones.size();
  for (std::size_t i = 0; i < single; ++i) cones.push_back(cones[i]);
  const Problem both(
      PrimalData{twice(whole.M()), twice(whole.H()), stacked(whole.f()), stacked(whole.w())}, cones,
      {});
  const std::vector<Island> islands = both.islands();
  EXPECT_EQ(islands.size(), 2 * whole.islands().size());
  EXPECT_EQ(both.features().islands, static_cast<int>(islands.size()));
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(both.rows(), -1.0, 1.0);
  const Eigen::VectorXd u = both.rate(r);
  std::size_t seen = 0;
  for (const Island& island : islands) {
    EXPECT_EQ(island.problem.rate_scale(), both.rate_scale());
    std::vector<int> rows;
    for (const int i : island.cones) {
      for (int k = 0; k < both.cones()[static_cast<std::size_t>(i)].dim; ++k) {
        rows.push_back(both.start(i) + k);
      }
    }
    EXPECT_LE((island.problem.rate(r(rows)) - u(rows)).norm(), 1e-12);
    expect_as_built_anew(island.problem);
    seen += island.cones.size();
  }
  EXPECT_EQ(seen, cones.size());
}

TEST(Problem, IslandsOfReducedProblemsAreAsBuiltAnew) {
  Eigen::MatrixXd W = Eigen::MatrixXd::Zero(9, 9);
  W.diagonal() << 1, 2, 3, 4, 5, 6, 7, 8, 9;
  W(0, 8) = W(8, 0) = 0.5;  // cones 0 and 2
  const Problem whole(ReducedData{sparse(W), Eigen::VectorXd::LinSpaced(9, -1.0, 1.0)},
                      std::vector<Cone>(3, Cone::coulomb(3, 0.5, 0.1)), named("three"));
  const std::vector<Island> islands = whole.islands();
  ASSERT_EQ(islands.size(), 2u);
  EXPECT_THAT(islands[0].cones, testing::ElementsAre(0, 2));
  EXPECT_EQ(islands[0].problem.mobility()[1], 9.0);
  for (const Island& island : islands) expect_as_built_anew(island.problem);
}

TEST(Sparse, CanonicalSortsSumsAndDrops) {
  SparseMatrix A(3, 4);
  A.resizeNonZeros(7);
  const int begin[] = {0, 4, 4, 7}, columns[] = {3, 0, 3, 1, 2, 2, 1};
  const double values[] = {1.0, 2.0, 4.0, 0.0, 5.0, -5.0, 6.0};
  std::copy(std::begin(begin), std::end(begin), A.outerIndexPtr());
  std::copy(std::begin(columns), std::end(columns), A.innerIndexPtr());
  std::copy(std::begin(values), std::end(values), A.valuePtr());
  const SparseMatrix B = canonical(A);
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(3, 4);
  expected(0, 0) = 2.0;
  expected(0, 3) = 5.0;
  expected(2, 1) = 6.0;
  EXPECT_EQ(Eigen::MatrixXd(B), expected);
  EXPECT_EQ(B.nonZeros(), 3);
  EXPECT_EQ(B.innerIndexPtr()[0], 0);
}

TEST(Problem, MobilityIsTheNormOfTheDiagonalBlocks) {
  const Problem problem = make_backwards({.cones = 15, .dims = {1, 2, 3, 6}, .seed = 4}).problem;
  const Eigen::MatrixXd W = problem.delassus();
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int dim = problem.cones()[static_cast<std::size_t>(i)].dim, at = problem.start(i);
    const Eigen::MatrixXd block = W.block(at, at, dim, dim);
    const double norm = block.jacobiSvd().singularValues()[0];
    EXPECT_NEAR(problem.mobility()[i], norm, 1e-13 * norm) << i;
  }
}

TEST(Problem, FeaturesCountWhatIsThere) {
  const Features f = make_backwards({.cones = 12, .dims = {3, 1}, .cohesive_share = 1.0, .seed = 6})
                         .problem.features();
  EXPECT_EQ(f.cones, 12);
  EXPECT_EQ(f.rows, 24);
  EXPECT_THAT(f.cones_of_dim, testing::ElementsAre(std::pair{1, 6}, std::pair{3, 6}));
  EXPECT_EQ(f.cohesive_share, 1.0);
  EXPECT_GT(f.kappa.first, 0.0);
  EXPECT_TRUE(f.block_diagonal_mass);
}

}  // namespace
}  // namespace conebench::problems
