// First-order methods (spg, apgd, uzawa, extragradient, admm): what tests/solvers/methods_test.cpp
// does not ask of every method, and the pieces they share.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "problems/made_backwards.h"
#include "problems/residual.h"
#include "solvers/cone_vectors.h"
#include "solvers/delassus_product.h"
#include "solvers/registry.h"
#include "tests/solvers/every_method.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::make_backwards;
using problems::PrimalData;
using problems::Problem;
using problems::ReducedData;
using problems::SparseMatrix;

SparseMatrix sparse(const Eigen::MatrixXd& dense) { return dense.sparseView(); }

// The primal problem with springs between neighbouring dofs: one component of all dofs in M.
Problem coupled(const Problem& problem) {
  const int dofs = problem.dofs();
  Eigen::MatrixXd M = problem.M();
  const double spring = 0.2 * M.diagonal().minCoeff();
  for (int k = 0; k + 1 < dofs; ++k) {
    M(k, k) += spring;
    M(k + 1, k + 1) += spring;
    M(k, k + 1) -= spring;
    M(k + 1, k) -= spring;
  }
  return Problem({sparse(M), problem.H(), problem.f(), problem.w()},
                 {problem.cones().begin(), problem.cones().end()}, {});
}

Problem reduced(const Problem& problem, const SparseMatrix& W) {
  return Problem(ReducedData{W, problem.q()}, {problem.cones().begin(), problem.cones().end()}, {},
                 problem.rate_scale());
}

class FirstOrder : public testing::TestWithParam<std::string> {
 protected:
  Result solve(const Problem& problem, double tol) {
    const Stop stop{.tol = tol, .max_iterations = 200000};
    return make_solver(GetParam()).solve(problem, {stop, {}, nullptr});
  }
};

// mu <= 0.3, where every seed tried has one u. |u - u'| is not bounded by eta, but for these
// well-conditioned problems it is a few hundred times eta U at most.
TEST_P(FirstOrder, FindsTheRatesThatGaussSeidelFinds) {
  constexpr double kTol = 1e-10;
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    const Problem problem = make_backwards({.cones = 15,
                                            .dims = {3, 1, 6, 2},
                                            .mu_high = 0.3,
                                            .theta_share = 0.5 * static_cast<double>(seed % 3),
                                            .cohesive_share = 0.3,
                                            .reduced = seed % 2 == 0,
                                            .seed = seed})
                                .problem.shifted();
    const Result expected = make_solver("gs").solve(problem, {{.tol = kTol}, {}, nullptr});
    ASSERT_EQ(expected.status, Status::kConverged) << seed;
    const Result result = solve(problem, kTol);
    EXPECT_EQ(result.status, Status::kConverged) << seed;
    const double apart = (problem.rate(result.r) - problem.rate(expected.r)).norm();
    EXPECT_LE(apart, 1e3 * kTol * problem.rate_scale()) << seed;
  }
}

TEST_P(FirstOrder, TakesAMassThatCouplesAllDofs) {
  const Problem problem = coupled(make_backwards({.cones = 12, .mu_high = 0.3, .seed = 5}).problem);
  ASSERT_FALSE(problem.inertia().block_diagonal());
  const Result primal = solve(problem, 1e-9);
  ASSERT_EQ(primal.status, Status::kConverged);
  const Result dual = solve(reduced(problem, problem.delassus()), 1e-9);
  ASSERT_EQ(dual.status, Status::kConverged);
  const double apart = (problem.rate(primal.r) - problem.rate(dual.r)).norm();
  EXPECT_LE(apart, 1e-6 * problem.rate_scale());
}

TEST_P(FirstOrder, SolvesForANonsymmetricWAsGiven) {
  const Problem symmetric = make_backwards({.cones = 12, .mu_high = 0.3, .seed = 6}).problem;
  Eigen::MatrixXd W = symmetric.delassus();
  W.triangularView<Eigen::StrictlyUpper>() = 0.98 * W;
  const Result result = solve(reduced(symmetric, sparse(W)), 1e-10);
  EXPECT_EQ(result.status, Status::kConverged);
}

TEST_P(FirstOrder, RefusesAProblemWhoseReactionsDoNothing) {
  const Problem problem(PrimalData{sparse(Eigen::Matrix3d::Identity()), SparseMatrix(3, 3),
                                   Eigen::Vector3d::Zero(), Eigen::Vector3d(-1.0, 0.0, 0.0)},
                        {Cone::coulomb(3, 0.5)}, {});
  const Result result = solve(problem, 1e-6);
  EXPECT_EQ(result.status, Status::kUnsupported);
  EXPECT_THAT(result.notes, testing::ElementsAre("W is zero"));
}

INSTANTIATE_TEST_SUITE_P(Registered, FirstOrder,
                         testing::Values("spg", "apgd", "apgd[refresh=5]", "uzawa", "extragradient",
                                         "extragradient[step=unit]", "admm", "admm[anderson=0]"),
                         test_name);

// Unit masses one on another, frictionless: W is tridiagonal, of condition about 0.4 masses^2.
Problem tower(int masses) {
  Eigen::MatrixXd H = Eigen::MatrixXd::Identity(masses, masses);
  for (int k = 1; k < masses; ++k) H(k, k - 1) = -1.0;
  return Problem(PrimalData{sparse(Eigen::MatrixXd::Identity(masses, masses)), sparse(H),
                            Eigen::VectorXd::Constant(masses, -1.0), Eigen::VectorXd::Zero(masses)},
                 std::vector<Cone>(static_cast<std::size_t>(masses), Cone::coulomb(1, 0.0)), {});
}

// Projected gradient needs iterations like the condition, Nesterov's like its root.
TEST(AcceleratedGradient, NeedsFarFewerIterationsThanItsPlainStepOnATallTower) {
  const Request request{{.tol = 1e-6}, {}, nullptr};
  const Result plain = make_solver("uzawa").solve(tower(60), request);
  const Result accelerated = make_solver("apgd").solve(tower(60), request);
  ASSERT_EQ(plain.status, Status::kConverged);
  ASSERT_EQ(accelerated.status, Status::kConverged);
  EXPECT_LE(5 * accelerated.iterations, plain.iterations);
}

TEST(Uzawa, FirstStepProjectsThePredictionOfEachContact) {
  const std::vector<double> lambda{0.5, 2.0, 8.0};
  Eigen::VectorXd q(9);
  q << -1.0, 0.2, -0.1, -1.0, 3.0, 4.0, 1.0, 0.1, 0.0;  // sticks, slides, opens
  Eigen::VectorXd diagonal(9);
  for (std::size_t i = 0; i < 3; ++i) {
    diagonal.segment<3>(3 * static_cast<Eigen::Index>(i)).setConstant(lambda[i]);
  }
  const Problem problem(ReducedData{sparse(diagonal.asDiagonal()), q},
                        std::vector<Cone>(3, Cone::coulomb(3, 0.5)), {});
  const Result result =
      make_solver("uzawa").solve(problem, {{.tol = 1e-300, .max_iterations = 1}, {}, nullptr});
  for (int i = 0; i < 3; ++i) {
    Eigen::VectorXd expected = q.segment<3>(3 * i);
    problems::add_de_saxce(0.5, expected);
    expected /= -lambda[static_cast<std::size_t>(i)];
    problems::project(0.5, expected);
    EXPECT_LE((result.r.segment<3>(3 * i) - expected).norm(), 1e-15) << i;
  }
}

TEST(Admm, FactorisesOnceUntilItFirstLooksAtRho) {
  const Problem problem = make_backwards({.cones = 20, .seed = 7}).problem;
  const Result result =
      make_solver("admm").solve(problem, {{.tol = 1e-300, .max_iterations = 10}, {}, nullptr});
  EXPECT_THAT(result.notes, testing::ElementsAre(testing::StartsWith("1 factor")));
}

TEST(Admm, LowersRhoWhereTheFactorisationFails) {
  // Symmetric, its lower eigenvalue -0.1: not what Problem promises, but what files may hold.
  Eigen::MatrixXd W(2, 2);
  W << 1.0, 1.1, 1.1, 1.0;
  const Problem problem(ReducedData{sparse(W), Eigen::Vector2d(-1.0, 1.0)},
                        std::vector<Cone>(2, Cone::coulomb(1, 0.0)), {});
  const Result result = make_solver("admm[rho=100]").solve(problem, {{.tol = 1e-9}, {}, nullptr});
  EXPECT_EQ(result.status, Status::kConverged);
  EXPECT_NEAR(result.r(0), 1.0, 1e-8);
  EXPECT_NEAR(result.r(1), 0.0, 1e-8);
}

TEST(ConeVectors, WorkConeByConeInEveryDimension) {
  const Problem problem = make_backwards({.cones = 10, .dims = {1, 2, 3, 4, 6}, .seed = 3}).problem;
  Eigen::VectorXd x = problem.q(), projected = x, shifted = x;
  project_on_cones(problem, projected);
  add_de_saxce(problem, shifted);
  const Eigen::VectorXd mobility = mobility_per_row(problem);
  double largest = 0.0;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    const int at = problem.start(i);
    Eigen::VectorXd part = x.segment(at, cone.dim);
    largest = std::max(largest, problem.mobility()(i) * part.norm());
    EXPECT_EQ(mobility.segment(at, cone.dim),
              Eigen::VectorXd::Constant(cone.dim, problem.mobility()(i)));
    problems::project(cone.mu, part);
    EXPECT_LE((projected.segment(at, cone.dim) - part).norm(), 1e-15 * part.norm());
    part = x.segment(at, cone.dim);
    problems::add_de_saxce(cone.theta, part);
    EXPECT_LE((shifted.segment(at, cone.dim) - part).norm(), 1e-15 * part.norm());
  }
  EXPECT_DOUBLE_EQ(size_as_rate(problem, x), largest);
}

TEST(DelassusProduct, GivesTheProductsOfTheProblemInEveryForm) {
  const Problem blocks = make_backwards({.cones = 12, .dims = {3, 6, 1}, .seed = 4}).problem;
  for (const Problem& problem : {blocks, coupled(blocks), reduced(blocks, blocks.delassus())}) {
    DelassusProduct product(problem);
    const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(problem.rows(), -1.0, 2.0);
    Eigen::VectorXd Wr, u;
    product.apply(r, Wr);
    product.rate(r, u);
    const Eigen::VectorXd expected = problem.apply_delassus(r);
    EXPECT_LE((Wr - expected).norm(), 1e-14 * expected.norm());
    EXPECT_LE((u - problem.rate(r)).norm(), 1e-13 * (expected.norm() + problem.q().norm()));
  }
}

// Reactions of three cones, rates of two, one of them among the three.
TEST(DelassusProduct, GivesTheRatesOfSomeConesFromTheReactionsOfSome) {
  const Problem blocks = make_backwards({.cones = 12, .dims = {3, 6, 1}, .seed = 4}).problem;
  const auto part = [&](auto& x, int i) -> auto{
    return x.segment(blocks.start(i), blocks.cones()[static_cast<std::size_t>(i)].dim);
  };
  const auto packed = [&](const std::vector<int>& cones, const Eigen::VectorXd& whole) {
    Eigen::VectorXd out;
    for (const int i : cones) {
      const Eigen::VectorXd added = part(whole, i);
      out.conservativeResize(out.size() + added.size());
      out.tail(added.size()) = added;
    }
    return out;
  };
  const std::vector<int> from = {1, 4, 9}, to = {4, 11};
  Eigen::VectorXd r = Eigen::VectorXd::Zero(blocks.rows());
  for (const int i : from) part(r, i).setConstant(1.0 + i);
  for (const Problem& problem : {blocks, reduced(blocks, blocks.delassus())}) {
    DelassusProduct product(problem);
    ASSERT_TRUE(product.has_parts());
    const Eigen::VectorXd expected = packed(to, problem.rate(r));
    Eigen::VectorXd u(expected.size());
    product.rate(from, packed(from, r), to, u);
    EXPECT_LE((u - expected).norm(), 1e-14 * expected.norm());
  }
  EXPECT_FALSE(DelassusProduct(coupled(blocks)).has_parts());
}

// Reactions a million times the rates' size: what rho and the factor leave is rounding of them.
TEST(Admm, SolvesForIncrementsWhereReactionsSwampRates) {
  const Problem plain = make_backwards({.cones = 12, .mu_high = 0.4, .seed = 11}).problem;
  std::vector<problems::Cone> cones(plain.cones().begin(), plain.cones().end());
  for (problems::Cone& cone : cones) cone.kappa = 1e6;
  const Problem primal = plain.with_laws(cones, plain.w()).shifted();
  for (const Problem& problem : {primal, reduced(primal, primal.delassus())}) {
    for (const std::string solver : {"admm", "admm[anderson=0]"}) {
      const Result result =
          make_solver(solver).solve(problem, {.stop = {.tol = 1e-8, .max_iterations = 1000}});
      EXPECT_EQ(result.status, Status::kConverged) << solver << " " << problem.is_primal();
    }
  }
}

// Some of the cones have no reaction at the answer, and others at the guess.
TEST(Apgd, FindsTheAnswerWithConesLeftOutForLong) {
  const Problem problem = make_backwards({.cones = 60, .dims = {3, 2, 6}, .seed = 5}).problem;
  Eigen::VectorXd guess = Eigen::VectorXd::Zero(problem.rows());
  for (int i = 0; i < problem.cone_count(); i += 2) guess(problem.start(i)) = 10.0;
  for (const std::string solver : {"apgd[skip=1]", "apgd", "apgd[skip=10000]"}) {
    const Result result =
        make_solver(solver).solve(problem, {.stop = {.tol = 1e-9}, .guess = guess});
    EXPECT_EQ(result.status, Status::kConverged) << solver;
    int open = 0;
    for (int i = 0; i < problem.cone_count(); ++i) {
      open += result.r.segment(problem.start(i), problem.cones()[static_cast<std::size_t>(i)].dim)
                  .isZero(0.0);
    }
    EXPECT_GT(open, problem.cone_count() / 4) << "too few for any to be left out";
  }
}

}  // namespace
}  // namespace conebench::solvers
