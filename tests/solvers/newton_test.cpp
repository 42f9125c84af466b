// The parts of the semismooth Newton methods: functions of a cone, systems, steps.

#include <gtest/gtest.h>

#include <random>

#include "problems/made_backwards.h"
#include "problems/residual.h"
#include "solvers/gs.h"
#include "solvers/newton/alart_curnier.h"
#include "solvers/newton/fischer_burmeister.h"
#include "solvers/newton/newton.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Family;
using problems::Problem;
using Function = NewtonSettings::Function;
using Form = GeneralSystem::Form;

std::vector<std::unique_ptr<ConeFunction>> functions() {
  std::vector<std::unique_ptr<ConeFunction>> all;
  all.push_back(std::make_unique<AlartCurnier>(AlartCurnier::Radius::kAlartCurnier, 1.0));
  all.push_back(std::make_unique<AlartCurnier>(AlartCurnier::Radius::kAlartCurnier, 0.3));
  all.push_back(std::make_unique<AlartCurnier>(AlartCurnier::Radius::kJeanMoreau, 2.0));
  all.push_back(std::make_unique<FischerBurmeister>());
  return all;
}

std::vector<Cone> laws() {
  return {{1, 0.0, 0.0, 0.0}, {1, 0.4, 0.0, 0.4}, {2, 0.5, 0.0, 0.5},
          {3, 0.7, 0.0, 0.7}, {3, 0.7, 0.0, 0.2}, {3, 0.7, 0.0, 0.0},
          {6, 1.5, 0.0, 1.5}, {4, 2.0, 0.0, 0.5}, {3, 0.0, 0.0, 0.0}};
}

Eigen::VectorXd random_vector(std::mt19937& random, Eigen::Index size) {
  std::normal_distribution<double> normal;
  return Eigen::VectorXd::NullaryExpr(size, [&] { return normal(random); });
}

// Central differences with h = 1e-6: error 1e-12 / distance to a kink^2 + 1e-10 of rounding.
TEST(ConeFunctions, JacobiansAreThoseOfFiniteDifferences) {
  constexpr double kStep = 1e-6;
  std::mt19937 random(5);
  for (const auto& function : functions()) {
    for (const Cone& cone : laws()) {
      for (int sample = 0; sample < 50; ++sample) {
        const Eigen::VectorXd p = random_vector(random, cone.dim),
                              u = random_vector(random, cone.dim);
        Eigen::MatrixXd dp(cone.dim, cone.dim), du(cone.dim, cone.dim);
        function->jacobian(cone, p, u, dp, du);
        Eigen::VectorXd above(cone.dim), below(cone.dim);
        for (int k = 0; k < cone.dim; ++k) {
          const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(cone.dim, k);
          function->value(cone, p + step, u, above);
          function->value(cone, p - step, u, below);
          EXPECT_LE((dp.col(k) - (above - below) / (2.0 * kStep)).norm(), 1e-5);
          function->value(cone, p, u + step, above);
          function->value(cone, p, u - step, below);
          EXPECT_LE((du.col(k) - (above - below) / (2.0 * kStep)).norm(), 1e-5);
        }
      }
    }
  }
}

TEST(ConeFunctions, VanishAtSolutions) {
  for (const double theta_share : {1.0, 0.5, 0.0}) {
    const auto known = problems::make_backwards(
        {.cones = 40, .dims = {3, 1, 2, 6}, .theta_share = theta_share, .seed = 4});
    const Eigen::VectorXd& r = known.solutions[0];
    const Eigen::VectorXd rates = known.problem.rate(r);
    for (const auto& function : functions()) {
      for (int i = 0; i < known.problem.cone_count(); ++i) {
        const Cone& cone = known.problem.cones()[static_cast<std::size_t>(i)];
        const int at = known.problem.start(i);
        const Eigen::VectorXd p = known.problem.mobility()(i) * r.segment(at, cone.dim);
        const Eigen::VectorXd u = rates.segment(at, cone.dim);
        Eigen::VectorXd phi(cone.dim);
        function->value(cone, p, u, phi);
        EXPECT_LE(phi.norm(), 1e-9 * (1.0 + p.norm() + u.norm()));
      }
    }
  }
}

// Elsewhere phi is of the size of eta's natural map |p - P_K(p - u_hat)|.
TEST(ConeFunctions, VanishAtSolutionsOnly) {
  std::mt19937 random(7);
  for (const auto& function : functions()) {
    for (const Cone& cone : laws()) {
      for (int sample = 0; sample < 50; ++sample) {
        const Eigen::VectorXd p = random_vector(random, cone.dim);
        const Eigen::VectorXd u = random_vector(random, cone.dim);
        Eigen::VectorXd u_hat = u, phi(cone.dim);
        problems::add_de_saxce(cone.theta, u_hat);
        Eigen::VectorXd projected = p - u_hat;
        problems::project(cone.mu, projected);
        function->value(cone, p, u, phi);
        EXPECT_GE(phi.norm(), 0.1 * (p - projected).norm());
      }
    }
  }
}

// phi and its Jacobian at a kink, and for mu far from 1, are finite and of the expected size.
TEST(ConeFunctions, AreSafeAtKinksAndForExtremeFriction) {
  const Eigen::Vector3d zero = Eigen::Vector3d::Zero();
  const std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> kinks = {
      {zero, zero},
      {{1.0, 0.0, 0.0}, zero},
      {zero, {1.0, 0.0, 0.0}},
      {{1.0, 0.5, 0.0}, zero},              // on the cone's edge, sticking
      {{1.0, 0.5, 0.0}, {0.0, -1.0, 0.0}},  // sliding
      {{1.0, 0.5, 0.0}, {1.0, 0.5, 0.0}}};
  for (const auto& function : functions()) {
    for (const double mu : {0.0, 1e-12, 1e-3, 0.5, 100.0}) {
      for (const auto& [p, u] : kinks) {
        Eigen::VectorXd phi(3);
        Eigen::MatrixXd dp(3, 3), du(3, 3);
        function->value(Cone::coulomb(3, mu), p, u, phi);
        function->jacobian(Cone::coulomb(3, mu), p, u, dp, du);
        EXPECT_TRUE(phi.allFinite() && dp.allFinite() && du.allFinite()) << mu;
        EXPECT_LE(du.norm(), 10.0 * std::max(1.0, mu * mu)) << mu;
      }
    }
  }
}

// The Jordan-algebra function for d = 2 is the scalar one in the cone's two generators.
TEST(FischerBurmeister, OfTwoDimensionsSplitsIntoTwoScalarFunctions) {
  const Cone cone{2, 1.0, 0.0, 0.0};
  const Eigen::Vector2d p(0.3, -1.2), u(0.8, 0.5);
  Eigen::VectorXd phi(2);
  FischerBurmeister().value(cone, p, u, phi);
  auto scalar = [](double a, double b) { return a + b - std::hypot(a, b); };
  EXPECT_NEAR(phi(0) + phi(1), scalar(p(0) + p(1), u(0) + u(1)), 1e-15);
  EXPECT_NEAR(phi(0) - phi(1), scalar(p(0) - p(1), u(0) - u(1)), 1e-15);
}

Problem made(bool reduced, Family family = Family::kGeneric) {
  return problems::make_backwards({.family = family,
                                   .cones = 20,
                                   .dims = {3, 1, 2, 6},
                                   .mu_high = 0.5,
                                   .reduced = reduced,
                                   .seed = 11})
      .problem;
}

TEST(GeneralSystem, AgreesWithDenseAlgebraInBothForms) {
  const Problem problem = made(false);
  std::mt19937 random(6);
  const Eigen::MatrixXd W = problem.delassus();
  const Eigen::VectorXd b = random_vector(random, problem.rows());
  // The second time with blocks that an LU must pivot around: A = 0 and indefinite B.
  for (const double share : {1.0, 0.0}) {
    BlockDiagonal A(problem), B(problem);
    Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(problem.rows(), problem.rows());
    for (int i = 0; i < problem.cone_count(); ++i) {
      const int dim = problem.cones()[static_cast<std::size_t>(i)].dim, at = problem.start(i);
      A[i] = share * random_vector(random, dim * dim).reshaped(dim, dim);
      B[i] = random_vector(random, dim * dim).reshaped(dim, dim);
      dense.middleRows(at, dim) = B[i] * W.middleRows(at, dim);
      dense.block(at, at, dim, dim) += A[i];
    }
    for (const Form form : {Form::kReduced, Form::kFull}) {
      GeneralSystem system(problem, form);
      ASSERT_TRUE(system.factorize(A, B));
      const Eigen::VectorXd x = system.solve(b);
      EXPECT_LE((dense * x - b).norm(), 1e-10 * (dense.norm() * x.norm() + b.norm()));
      ASSERT_TRUE(system.factorize(A, B));
      EXPECT_EQ(x, system.solve(b));
    }
  }
}

TEST(GeneralSystem, SaysSoWhenTheMatrixIsSingular) {
  const Problem problem = made(false);
  for (const Form form : {Form::kReduced, Form::kFull}) {
    GeneralSystem system(problem, form);
    EXPECT_FALSE(system.factorize(BlockDiagonal(problem), BlockDiagonal(problem)));
  }
}

TEST(Newton, ReducedAndFullFormTakeTheSameSteps) {
  const Problem problem = made(false);
  for (const Function function :
       {Function::kAlartCurnier, Function::kJeanMoreau, Function::kFischerBurmeister}) {
    const auto reduced = make_newton(problem, {.function = function, .form = Form::kReduced});
    const auto full = make_newton(problem, {.function = function, .form = Form::kFull});
    reduced->start(Eigen::VectorXd::Zero(problem.rows()));
    full->start(Eigen::VectorXd::Zero(problem.rows()));
    for (int step = 0; step < 4; ++step) {
      reduced->advance();
      full->advance();
      EXPECT_LE((reduced->r() - full->r()).norm(), 1e-7 * reduced->r().norm()) << step;
    }
  }
}

TEST(Newton, OwnEtaIsEta) {
  const Problem problem = made(true);
  const auto newton = make_newton(problem, {});
  newton->start(Eigen::VectorXd::Zero(problem.rows()));
  for (int step = 0; step < 3; ++step) {
    const double eta = problems::evaluate_eta(problem, newton->r());
    EXPECT_NEAR(newton->own_eta(), eta, 1e-9 * eta);
    newton->advance();
  }
}

// Full rank, near a solution: eta falls at least tenfold a step, and at last to rounding.
// The iterate of least own_eta() among r and the next `steps`.
Eigen::VectorXd best_of_steps(Iteration& iteration, const Eigen::VectorXd& r, int steps) {
  iteration.start(r);
  Eigen::VectorXd best = r;
  double least = iteration.own_eta();
  for (int step = 0; step < steps; ++step) {
    if (iteration.advance() != Iteration::State::kRunning) break;
    const double eta = iteration.own_eta();
    if (eta < least) {
      least = eta;
      best = iteration.r();
    }
  }
  return best;
}

TEST(Newton, PlainStepsPolishToRounding) {
  const auto known =
      problems::make_backwards({.cones = 20, .dims = {3, 2}, .mu_high = 0.5, .seed = 12});
  const Eigen::VectorXd near = (1.0 + 1e-4) * known.solutions[0];
  const auto newton =
      make_newton(known.problem, {.line_search = LineSearch::kNone, .regularisation = 0.0});
  const Eigen::VectorXd polished = best_of_steps(*newton, near, 6);
  EXPECT_LE(problems::evaluate_eta(known.problem, polished), 1e-11);
  EXPECT_EQ(best_of_steps(*newton, near, 0), near);
}

TEST(Newton, SolvesProblemsOfSingularW) {
  for (const Family family : {Family::kRankDeficient, Family::kSingularBlock}) {
    const Problem problem = made(false, family);
    for (const char* variant : {"newton-ac", "newton-ac[variant=jean-moreau]", "newton-fb"}) {
      const Result result =
          make_solver(variant).solve(problem, {{.tol = 1e-8, .max_iterations = 1000}, {}, nullptr});
      EXPECT_EQ(result.status, Status::kConverged) << variant << " " << static_cast<int>(family);
    }
  }
}

TEST(Newton, WarmUpStartsFromGaussSeidelSweeps) {
  const Problem problem = made(true);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.rows());
  const auto newton = make_newton(problem, {.warmup = 3});
  newton->start(zero);
  for (int sweep = 0; sweep < 3; ++sweep) newton->advance();
  const auto sweeps = make_gauss_seidel(problem);
  sweeps->start(zero);
  for (int sweep = 0; sweep < 3; ++sweep) sweeps->advance();
  EXPECT_LE((newton->r() - sweeps->r()).norm(), 1e-13 * sweeps->r().norm());
}

TEST(Newton, FullFormIsRefusedWithoutAMass) {
  EXPECT_FALSE(make_solver("newton-ac[form=full]").supports(made(true)));
}

// The iterates are those of the same problem in other units, rescaled.
TEST(Newton, StepsDoNotDependOnUnits) {
  const Problem problem = made(true);
  const Problem other(problems::ReducedData{problem.W() * 1e6, problem.q() * 1e3},
                      {problem.cones().begin(), problem.cones().end()}, {});
  for (const Function function : {Function::kAlartCurnier, Function::kFischerBurmeister}) {
    const auto here = make_newton(problem, {.function = function});
    const auto there = make_newton(other, {.function = function});
    here->start(Eigen::VectorXd::Zero(problem.rows()));
    there->start(Eigen::VectorXd::Zero(problem.rows()));
    for (int step = 0; step < 4; ++step) {
      here->advance();
      there->advance();
      EXPECT_LE((here->r() - 1e3 * there->r()).norm(), 1e-8 * here->r().norm());
    }
  }
}

TEST(LineSearches, FindTheStepsTheyPromise) {
  // m(t) = (t - 1)^2 / 2 has slope -1 at 0; m(t) = (t - s)^2 its minimum at s.
  auto merit = [](double s) {
    return [s](double t) { return 0.5 * (t / s - 1.0) * (t / s - 1.0); };
  };
  for (const LineSearch kind :
       {LineSearch::kArmijo, LineSearch::kGoldsteinPrice, LineSearch::kNonMonotone}) {
    EXPECT_EQ(StepLength(kind).find(merit(1.0), 0.5, -1.0), 1.0);
    const auto shortened = StepLength(kind).find(merit(0.01), 0.5, -100.0);
    ASSERT_TRUE(shortened);
    EXPECT_LE(merit(0.01)(*shortened), 0.5);
    auto rising = [](double t) { return 1.0 + t; };
    EXPECT_FALSE(StepLength(kind).find(rising, 1.0, -1.0));
  }
  // Goldstein and Price lengthen a step that is too short.
  EXPECT_GT(*StepLength(LineSearch::kGoldsteinPrice).find(merit(20.0), 0.5, -0.05), 1.0);
  // The memory of a higher merit lets a rise pass.
  StepLength step_length(LineSearch::kNonMonotone);
  EXPECT_TRUE(step_length.find(merit(1.0), 2.0, -1.0));
  EXPECT_EQ(step_length.find([](double t) { return 0.5 + t; }, 0.5, -1.0), 1.0);
  step_length.restart();
  EXPECT_FALSE(step_length.find([](double t) { return 0.5 + t; }, 0.5, -1.0));
}

}  // namespace
}  // namespace conebench::solvers
