// What every method owes, on problems with known answers.

#include <gtest/gtest.h>

#include <algorithm>

#include "problems/error.h"
#include "problems/made_backwards.h"
#include "problems/residual.h"
#include "solvers/gs.h"
#include "solvers/monitor.h"
#include "solvers/registry.h"
#include "tests/solvers/every_method.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Family;
using problems::PrimalData;
using problems::Problem;
using problems::ReducedData;
using problems::SparseMatrix;

SparseMatrix sparse(const Eigen::MatrixXd& dense) { return dense.sparseView(); }

class EveryMethod : public testing::TestWithParam<std::string> {
 protected:
  Solver solver_ = make_solver(GetParam());
  double attainable_ = attainable(GetParam());

  Result solve(const Problem& problem, const Stop& stop, Eigen::VectorXd guess = {}) {
    return solver_.solve(problem.shifted(), {stop, std::move(guess), nullptr});
  }
};

// 2 kg on a slope, one step of 0.01 s from rest.
Problem block_on_slope(double slope_rad, double mu, bool reduced) {
  constexpr double kMass = 2.0, kKick = 9.81 * 0.01;
  const Eigen::Vector3d free(-kKick * std::cos(slope_rad), kKick * std::sin(slope_rad), 0.0);
  const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
  if (reduced) {
    return Problem(ReducedData{sparse(I / kMass), free}, {Cone::coulomb(3, mu)}, {});
  }
  return Problem(PrimalData{sparse(kMass * I), sparse(I), kMass * free, Eigen::Vector3d::Zero()},
                 {Cone::coulomb(3, mu)}, {});
}

TEST_P(EveryMethod, BlockSticksOnAGentleSlopeAndSlidesOnASteepOne) {
  const double kick = 2.0 * 9.81 * 0.01;
  for (const bool reduced : {false, true}) {
    const Result stick = solve(block_on_slope(0.3, 0.5, reduced), {.tol = 1e-12});
    EXPECT_EQ(stick.status, Status::kConverged);
    EXPECT_NEAR(stick.r(0), kick * std::cos(0.3), 1e-11);
    EXPECT_NEAR(stick.r(1), -kick * std::sin(0.3), 1e-11);
    const Result slide = solve(block_on_slope(0.9, 0.5, reduced), {.tol = 1e-12});
    EXPECT_EQ(slide.status, Status::kConverged);
    EXPECT_NEAR(slide.r(0), kick * std::cos(0.9), 1e-11);
    EXPECT_NEAR(slide.r(1), -0.5 * slide.r(0), 1e-11);
  }
}

// n unit masses one on another: contact k carries the weight of the n - k masses above it.
TEST_P(EveryMethod, StackCarriesTheWeightAboveEachContact) {
  constexpr int kMasses = 4;
  constexpr double kKick = 0.0981;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(3 * kMasses, 3 * kMasses);
  Eigen::VectorXd f = Eigen::VectorXd::Zero(3 * kMasses);
  for (int k = 0; k < kMasses; ++k) {
    H.block<3, 3>(3 * k, 3 * k).setIdentity();
    if (k > 0) H.block<3, 3>(3 * k, 3 * k - 3) = -Eigen::Matrix3d::Identity();
    f(3 * k) = -kKick;
  }
  const Problem stack(PrimalData{sparse(Eigen::MatrixXd::Identity(3 * kMasses, 3 * kMasses)),
                                 sparse(H), f, Eigen::VectorXd::Zero(3 * kMasses)},
                      std::vector<Cone>(kMasses, Cone::coulomb(3, 0.5)), {});
  const Result result = solve(stack, {.tol = 1e-11});
  ASSERT_EQ(result.status, Status::kConverged);
  for (int k = 0; k < kMasses; ++k) {
    EXPECT_NEAR(result.r(3 * k), (kMasses - k) * kKick, 1e-9) << "contact " << k;
    EXPECT_NEAR(result.r.segment<2>(3 * k + 1).norm(), 0.0, 1e-9);
  }
}

// Pulled off at 1 m/s, unit mass: holds if kappa >= 1 N s, and lets go at 1 - kappa otherwise.
TEST_P(EveryMethod, CohesionHoldsToExactlyItsStrength) {
  auto pulled = [](double kappa) {
    const Eigen::Matrix3d I = Eigen::Matrix3d::Identity();
    return Problem(
        PrimalData{sparse(I), sparse(I), Eigen::Vector3d(1.0, 0.0, 0.0), Eigen::Vector3d::Zero()},
        {Cone::coulomb(3, 0.5, kappa)}, {});
  };
  const Problem strong = pulled(1.5), weak = pulled(0.25);
  const Result holds = solve(strong, {.tol = 1e-12}), breaks = solve(weak, {.tol = 1e-12});
  EXPECT_NEAR(strong.shifted().rate(holds.r)(0), 0.0, 1e-11);
  EXPECT_NEAR(holds.r(0) - 1.5, -1.0, 1e-11);  // r = r' - kappa: a pull of 1 N s
  EXPECT_NEAR(weak.shifted().rate(breaks.r)(0), 0.75, 1e-11);
}

TEST_P(EveryMethod, FindsMadeSolutionsOfAllDimensions) {
  const double tol = std::max(1e-9, attainable_);
  for (const std::vector<int>& dims :
       {std::vector<int>{1}, {2}, {3}, {6}, {4}, std::vector<int>{3, 1, 6, 2}}) {
    for (const bool reduced : {false, true}) {
      const Problem problem = problems::make_backwards({.cones = 12,
                                                        .dims = dims,
                                                        .mu_high = 0.5,
                                                        .cohesive_share = 0.5,
                                                        .reduced = reduced,
                                                        .seed = 21})
                                  .problem;
      const Result result = solve(problem, {.tol = tol, .max_iterations = 200000});
      EXPECT_EQ(result.status, Status::kConverged) << problem.name();
      EXPECT_LE(problems::evaluate_eta(problem.shifted(), result.r), tol) << problem.name();
    }
  }
}

TEST_P(EveryMethod, AssociatedLawGivesTheUniqueReactionsOfTheConvexProblem) {
  const auto made = problems::make_backwards(
      {.cones = 10, .dims = {3, 2}, .theta_share = 0.0, .mass_ratio = 2.0, .seed = 22});
  const double tol = std::max(1e-11, attainable_);
  const Result result = solve(made.problem, {.tol = tol, .max_iterations = 200000});
  ASSERT_EQ(result.status, Status::kConverged);
  EXPECT_LE((result.r - made.solutions[0]).norm(), 1e-6 * made.solutions[0].norm());
}

TEST_P(EveryMethod, StartsFromAGuessThatSolvesTheProblemAndStopsAtOnce) {
  const auto made = problems::make_backwards({.cones = 10, .seed = 23});
  const Result result = solve(made.problem, {.tol = 1e-9}, made.solutions[0]);
  EXPECT_EQ(result.status, Status::kConverged);
  EXPECT_EQ(result.iterations, 0);
}

TEST_P(EveryMethod, NeverClaimsToSolveWhatHasNoSolution) {
  const Problem problem =
      problems::make_backwards({.family = Family::kInfeasible, .cones = 6, .seed = 3}).problem;
  for (const StopTest test : {StopTest::kCommon, StopTest::kOwn}) {
    const Result result = solve(problem, {.tol = 1e-6, .max_iterations = 2000, .test = test});
    EXPECT_NE(result.status, Status::kConverged);
    EXPECT_EQ(result.r.size(), problem.rows());
  }
}

TEST_P(EveryMethod, OwnTestIsNotLooserThanItSays) {
  const Problem problem =
      problems::make_backwards({.cones = 12, .mu_high = 0.5, .seed = 21}).problem;
  const Result result =
      solve(problem, {.tol = 1e-7, .max_iterations = 200000, .test = StopTest::kOwn});
  ASSERT_EQ(result.status, Status::kConverged);
  EXPECT_LE(problems::evaluate_eta(problem, result.r), 1.5e-7);
}

TEST_P(EveryMethod, RespectsTheIterationLimitAndReportsIt) {
  const Problem problem = problems::make_backwards({.cones = 30, .seed = 24}).problem;
  const Result result = solve(problem, {.tol = 1e-300, .max_iterations = 7});
  EXPECT_EQ(result.status, Status::kIterationLimit);
  EXPECT_EQ(result.iterations, 7);
}

TEST_P(EveryMethod, SolvesTheEmptyProblem) {
  const Problem empty(PrimalData{sparse(Eigen::Matrix3d::Identity()), SparseMatrix(0, 3),
                                 Eigen::Vector3d::Ones(), Eigen::VectorXd(0)},
                      {}, {});
  const Result result = solve(empty, {});
  EXPECT_EQ(result.status, Status::kConverged);
  EXPECT_EQ(result.r.size(), 0);
}

TEST_P(EveryMethod, RefusesAGuessOfTheWrongLengthAndAnUnshiftedProblem) {
  const Problem problem =
      problems::make_backwards({.cones = 4, .cohesive_share = 1.0, .seed = 2}).problem;
  EXPECT_THROW(solve(problem, {}, Eigen::VectorXd::Zero(3)), problems::InputError);
  EXPECT_THROW(solver_.solve(problem, {}), problems::InputError);
}

INSTANTIATE_TEST_SUITE_P(Registered, EveryMethod, testing::ValuesIn(kEveryMethod), test_name);

TEST(InteriorPoint, QuasidefiniteFormSolvesPrimalProblemsAndRefusesReducedOnes) {
  const Solver solver = make_solver("aclm-ipm[form=kkt]");
  const double kick = 2.0 * 9.81 * 0.01;
  for (const auto& [slope, friction] :
       {std::pair{0.3, -std::sin(0.3)}, std::pair{0.9, -0.5 * std::cos(0.9)}}) {
    const Result result =
        solver.solve(block_on_slope(slope, 0.5, false), {{.tol = 1e-12}, {}, nullptr});
    EXPECT_EQ(result.status, Status::kConverged);
    EXPECT_NEAR(result.r(0), kick * std::cos(slope), 1e-11);
    EXPECT_NEAR(result.r(1), kick * friction, 1e-11);
  }
  EXPECT_FALSE(solver.supports(block_on_slope(0.3, 0.5, true)));
}

// Only Gauss-Seidel takes W = 0, and not where it would have to form a large dense W.
TEST(Automatic, RefusesWhatEachOfItsMethodsRefuses) {
  constexpr int kCones = 2001, kDofs = 3000;
  SparseMatrix M(kDofs, kDofs);
  for (int k = 0; k < kDofs; ++k) {
    M.insert(k, k) = 4.0;
    if (k > 0) M.insert(k, k - 1) = M.insert(k - 1, k) = 1.0;
  }
  Eigen::VectorXd w = Eigen::VectorXd::Zero(3 * kCones);
  w(0) = -1.0;
  const auto problem = [&](int cones) {
    return Problem(PrimalData{M, SparseMatrix(3 * cones, kDofs), Eigen::VectorXd::Zero(kDofs),
                              w.head(3 * cones)},
                   std::vector<Cone>(static_cast<std::size_t>(cones), Cone::coulomb(3, 0.5)), {});
  };
  const Result refused = make_solver("auto").solve(problem(kCones), {});
  EXPECT_EQ(refused.status, Status::kUnsupported);
  EXPECT_EQ(refused.r.size(), 3 * kCones);
  ASSERT_EQ(refused.notes.size(), 1u);
  EXPECT_NE(refused.notes[0].find("W is zero"), std::string::npos);
  EXPECT_NE(refused.notes[0].find("6003 rows"), std::string::npos);
  const Result tried = make_solver("auto").solve(problem(2), {{.max_iterations = 5}, {}, nullptr});
  EXPECT_NE(tried.status, Status::kUnsupported);
  EXPECT_NE(tried.status, Status::kConverged);
}

TEST(GaussSeidel, BothFormsTakeTheSameSteps) {
  const Problem problem =
      problems::make_backwards({.cones = 25, .dims = {3, 2, 6}, .seed = 31}).problem;
  const Stop stop{.tol = 1e-300, .max_iterations = 5};
  const Result velocity = make_solver("gs[form=velocity]").solve(problem, {stop, {}, nullptr});
  const Result delassus = make_solver("gs[form=delassus]").solve(problem, {stop, {}, nullptr});
  EXPECT_LE((velocity.r - delassus.r).norm(), 1e-10 * velocity.r.norm());
}

TEST(GaussSeidel, VelocityFormIsRefusedWithoutABlockDiagonalMass) {
  const Problem reduced = problems::make_backwards({.reduced = true}).problem;
  const Solver solver = make_solver("gs[form=velocity]");
  EXPECT_FALSE(solver.supports(reduced));
  const Result result = solver.solve(reduced, {});
  EXPECT_EQ(result.status, Status::kUnsupported);
  EXPECT_EQ(result.notes.size(), 1u);
}

TEST(GaussSeidel, FindsOneOfSeveralSolutions) {
  const auto made = problems::make_backwards({.family = Family::kSeveral, .cones = 5, .seed = 8});
  const Solver solver = make_solver("gs");
  // From r = 0, which is a solution; from beside the sliding one, whichever it finds solves it.
  EXPECT_EQ(solver.solve(made.problem, {}).iterations, 0);
  const Result other = solver.solve(made.problem, {{}, 1.01 * made.solutions[1], nullptr});
  EXPECT_EQ(other.status, Status::kConverged);
}

TEST(GaussSeidel, SolvesSingularBlocks) {
  const auto made = problems::make_backwards(
      {.family = Family::kSingularBlock, .cones = 12, .mu_high = 0.4, .seed = 9});
  EXPECT_EQ(make_solver("gs").solve(made.problem, {{.tol = 1e-8}, {}, nullptr}).status,
            Status::kConverged);
}

TEST(GaussSeidel, QuarticTakesTheStepsOfExact) {
  const Problem problem =
      problems::make_backwards({.cones = 25, .dims = {3, 1}, .mu_high = 0.5, .seed = 32}).problem;
  const Stop few{.tol = 1e-300, .max_iterations = 5};
  const Result exact = make_solver("gs").solve(problem, {few, {}, nullptr});
  const Result quartic = make_solver("gs[local=quartic]").solve(problem, {few, {}, nullptr});
  EXPECT_LE((exact.r - quartic.r).norm(), 1e-9 * exact.r.norm());
  EXPECT_EQ(make_solver("gs[local=quartic]").solve(problem, {{.tol = 1e-9}, {}, nullptr}).status,
            Status::kConverged);
}

TEST(GaussSeidel, QuarticRefusesOtherDimensionsAndDilatancy) {
  const Solver solver = make_solver("gs[local=quartic]");
  EXPECT_TRUE(solver.supports(problems::make_backwards({.dims = {3, 1}}).problem));
  EXPECT_FALSE(solver.supports(problems::make_backwards({.dims = {3, 2}}).problem));
  EXPECT_FALSE(solver.supports(problems::make_backwards({.theta_share = 0.5}).problem));
}

TEST(GaussSeidel, PartialSweepsReachWhatFullSweepsReach) {
  const Problem problem =
      problems::make_backwards({.cones = 40, .dims = {3, 2}, .mu_high = 0.5, .seed = 33}).problem;
  for (const char* variant : {"gs[skip=3]", "gs[islands=true]", "gs[islands=true,skip=3]"}) {
    const Result result = make_solver(variant).solve(problem, {{.tol = 1e-10}, {}, nullptr});
    EXPECT_EQ(result.status, Status::kConverged) << variant;
    EXPECT_LE(problems::evaluate_eta(problem, result.r), 1e-10) << variant;
  }
}

TEST(GaussSeidel, IsDrivenSweepBySweepByOthers) {
  const Problem problem =
      problems::make_backwards({.cones = 15, .mu_high = 0.5, .seed = 34}).problem;
  const std::unique_ptr<Iteration> sweeps = make_gauss_seidel(problem);
  sweeps->start(Eigen::VectorXd::Zero(problem.rows()));
  EXPECT_TRUE(std::isinf(sweeps->own_eta()));
  for (int k = 0; k < 5; ++k) sweeps->advance();
  const Stop five{.tol = 1e-300, .max_iterations = 5, .test = StopTest::kOwn};
  EXPECT_EQ(sweeps->r(), make_solver("gs").solve(problem, {five, {}, nullptr}).r);
  EXPECT_GT(sweeps->own_eta(), 0.0);
  EXPECT_LT(sweeps->own_eta(), 1.0);
}

}  // namespace
}  // namespace conebench::solvers
