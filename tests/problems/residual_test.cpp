#include "problems/residual.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "problems/error.h"
#include "problems/made_backwards.h"

namespace conebench::problems {
namespace {

SparseMatrix sparse(const Eigen::MatrixXd& dense) { return dense.sparseView(); }

// A mass on a slope of 45 degrees, mu = 0.5, one step from rest: the sliding solution by hand.
struct SlidingBlock {
  static constexpr double kMass = 2.0, kKick = 0.0981;
  Problem problem{
      PrimalData{sparse(kMass * Eigen::Matrix3d::Identity()), sparse(Eigen::Matrix3d::Identity()),
                 kMass* kKick* std::sqrt(0.5) * Eigen::Vector3d(-1.0, 1.0, 0.0),
                 Eigen::Vector3d::Zero()},
      {Cone::coulomb(3, 0.5)},
      {}};
  Eigen::Vector3d r = kMass * kKick * std::sqrt(0.5) * Eigen::Vector3d(1.0, -0.5, 0.0);
};

TEST(Residual, VanishesForTheSlidingBlockAndNotWithAnySignTurned) {
  const SlidingBlock block;
  EXPECT_LE(evaluate_residual(block.problem, block.r).eta.max, 1e-15);
  Eigen::Vector3d wrong = block.r;
  wrong(1) = -wrong(1);
  EXPECT_GT(evaluate_residual(block.problem, wrong).eta.max, 0.1);
  wrong = -block.r;
  EXPECT_GT(evaluate_residual(block.problem, wrong).eta.max, 0.1);
}

TEST(Residual, PhysicalPartsOfTheSlidingBlockAreThoseOfTheClosedForm) {
  const SlidingBlock block;
  const Residual at_rest = evaluate_residual(block.problem, Eigen::Vector3d::Zero());
  EXPECT_DOUBLE_EQ(at_rest.eta.max, 1.0);
  EXPECT_DOUBLE_EQ(at_rest.penetration_rate.max, SlidingBlock::kKick * std::sqrt(0.5));
  Eigen::Vector3d r = block.r;
  r(2) = 0.25 * r(0);  // friction turned by atan(1/2) from -u_t, and 12 % too large
  const Residual turned = evaluate_residual(block.problem, r);
  EXPECT_NEAR(turned.cone_violation.max, r.tail<2>().norm() - 0.5 * r(0), 1e-16);
  EXPECT_EQ(turned.tension.max, 0.0);
  EXPECT_LE(turned.momentum.max, 1e-15);
}

TEST(Residual, VanishesAtMadeSolutionsOfEveryKind) {
  for (const Family family :
       {Family::kGeneric, Family::kRankDeficient, Family::kSingularBlock, Family::kSeveral}) {
    for (const double theta : {1.0, 0.5, 0.0}) {
      for (const bool reduced : {false, true}) {
        const Recipe recipe{.family = family,
                            .cones = 24,
                            .dims = {3, 2, 6},
                            .theta_share = family == Family::kSeveral ? 1.0 : theta,
                            .cohesive_share = 0.5,
                            .reduced = reduced,
                            .seed = 11};
        const MadeProblem made = make_backwards(recipe);
        for (const Eigen::VectorXd& r : made.solutions) {
          const Residual residual = evaluate_residual(made.problem.shifted(), r);
          EXPECT_LE(residual.eta.max, 1e-12) << made.problem.name();
          EXPECT_LE(residual.fischer_burmeister, 1e-20) << made.problem.name();
          EXPECT_LE(residual.alart_curnier, 1e-20) << made.problem.name();
          EXPECT_LE(residual.work.max, 1e-12) << made.problem.name();
        }
      }
    }
  }
}

// Written from the formulas alone, densely, for comparison.
double dense_eta(const Problem& original, const Eigen::VectorXd& r) {
  const Eigen::MatrixXd W = original.delassus();
  auto project_on = [](double mu, Eigen::VectorXd x) {
    const double n = x(0), t = x.tail(x.size() - 1).norm();
    if (t <= mu * n && n >= 0.0) return x;
    if (mu * t <= -n) return Eigen::VectorXd(Eigen::VectorXd::Zero(x.size()));
    const double s = (n + mu * t) / (1.0 + mu * mu);
    Eigen::VectorXd p(x.size());
    p(0) = s;
    p.tail(x.size() - 1) = mu * s * x.tail(x.size() - 1) / t;
    return p;
  };
  auto hat = [](double theta, Eigen::VectorXd u) {
    u(0) += theta * u.tail(u.size() - 1).norm();
    return u;
  };
  const Eigen::VectorXd u = original.q() + W * (r - original.tip_shift());
  double worst = 0.0, s = 0.0, S = 0.0;
  const Eigen::VectorXd carried =
      original.is_primal()
          ? Eigen::VectorXd(Eigen::MatrixXd(original.H()).cwiseAbs() *
                            Eigen::MatrixXd(original.M()).ldlt().solve(original.f()).cwiseAbs())
          : Eigen::VectorXd(Eigen::VectorXd::Zero(original.rows()));
  for (int i = 0; i < original.cone_count(); ++i) {
    const Cone& c = original.cones()[static_cast<std::size_t>(i)];
    const int a = original.start(i);
    const double lambda =
        Eigen::JacobiSVD<Eigen::MatrixXd>(W.block(a, a, c.dim, c.dim)).singularValues()(0);
    const Eigen::VectorXd ri = r.segment(a, c.dim), ui = hat(c.theta, u.segment(a, c.dim));
    worst = std::max(worst, lambda * (ri - project_on(c.mu, ri - ui / lambda)).norm());
    const Eigen::VectorXd q = original.q().segment(a, c.dim);
    s = std::max(
        {s, project_on(c.mu, -hat(c.theta, q)).norm(), std::min(q.norm(), lambda * c.kappa)});
    S = std::max({S, q.norm(), lambda * c.kappa, carried.segment(a, c.dim).norm()});
  }
  return worst / std::max(s, 1e-6 * S);
}

TEST(Residual, AgreesWithADenseEvaluationAtAnyReaction) {
  for (const bool reduced : {false, true}) {
    const Problem problem = make_backwards({.family = Family::kRankDeficient,
                                            .cones = 20,
                                            .dims = {3, 1, 6, 2},
                                            .theta_share = 0.7,
                                            .cohesive_share = 0.5,
                                            .reduced = reduced,
                                            .seed = 12})
                                .problem;
    for (const double size : {0.0, 1.0, 1e6}) {
      const Eigen::VectorXd r =
          size * Eigen::VectorXd::LinSpaced(problem.rows(), -0.5, 1.0).array().sin();
      const double expected = dense_eta(problem, r);
      EXPECT_NEAR(evaluate_eta(problem.shifted(), r), expected, 1e-11 * expected);
      EXPECT_EQ(evaluate_eta(problem.shifted(), r),
                evaluate_residual(problem.shifted(), r).eta.max);
    }
  }
}

TEST(Residual, DoesNotChangeWithUnitsOrTheTangentFrame) {
  const Problem problem = make_backwards({.cones = 10, .cohesive_share = 0.5, .seed = 13}).problem;
  const Eigen::VectorXd r = Eigen::VectorXd::LinSpaced(problem.rows(), 0.1, 1.0);
  const double eta = evaluate_eta(problem.shifted(), r);
  const double force = 1e3, rate = 1e-2;  // new r = force r, new u = rate u
  std::vector<Cone> cones(problem.cones().begin(), problem.cones().end());
  for (Cone& cone : cones) cone.kappa *= force;
  const Problem scaled(PrimalData{problem.M() * (force / rate), problem.H(), problem.f() * force,
                                  problem.w() * rate},
                       cones, {});
  EXPECT_NEAR(evaluate_eta(scaled.shifted(), force * r), eta, 1e-12 * eta);

  Eigen::MatrixXd turn = Eigen::MatrixXd::Identity(problem.rows(), problem.rows());
  for (int i = 0; i < problem.cone_count(); ++i) {
    const double angle = 0.3 * (i + 1);
    turn.block<2, 2>(problem.start(i) + 1, problem.start(i) + 1) =
        Eigen::Rotation2Dd(angle).toRotationMatrix();
  }
  cones.assign(problem.cones().begin(), problem.cones().end());
  const Problem turned(
      PrimalData{problem.M(), sparse(turn * problem.H()), problem.f(), turn * problem.w()}, cones,
      {});
  EXPECT_NEAR(evaluate_eta(turned.shifted(), turn * r), eta, 1e-12 * eta);
}

// W = 0: nothing can be done, and eta at r = 0 is the whole violation.
TEST(Residual, IsOneWhereNothingMoves) {
  const Problem stuck(PrimalData{sparse(Eigen::Matrix3d::Identity()), SparseMatrix(3, 3),
                                 Eigen::Vector3d::Zero(), Eigen::Vector3d(-2.0, 0.0, 0.0)},
                      {Cone::coulomb(3, 0.5)}, {});
  EXPECT_DOUBLE_EQ(evaluate_eta(stuck, Eigen::Vector3d::Zero()), 1.0);
}

TEST(Residual, IsInfiniteForANaN) {
  const SlidingBlock block;
  Eigen::Vector3d r = block.r;
  r(2) = NAN;
  const Residual residual = evaluate_residual(block.problem, r);
  EXPECT_FALSE(residual.finite);
  EXPECT_TRUE(std::isinf(residual.eta.max));
  EXPECT_TRUE(std::isinf(evaluate_eta(block.problem, r)));
}

TEST(Residual, RefusesAProblemThatStillHasCohesionAndAWrongLength) {
  const Problem cohesive = make_backwards({.cones = 3, .cohesive_share = 1.0, .seed = 14}).problem;
  EXPECT_THROW(evaluate_residual(cohesive, Eigen::VectorXd::Zero(9)), InputError);
  EXPECT_THROW(evaluate_residual(cohesive.shifted(), Eigen::VectorXd::Zero(8)), InputError);
}

TEST(MadeBackwards, IsTheSameForTheSameSeedOnly) {
  const Recipe recipe{.cones = 9, .dims = {3, 2}, .seed = 1};
  Recipe other = recipe;
  other.seed = 2;
  const Problem a = make_backwards(recipe).problem, b = make_backwards(recipe).problem;
  EXPECT_EQ(a.q(), b.q());
  EXPECT_NE(a.q(), make_backwards(other).problem.q());
}

TEST(MadeBackwards, InfeasibleProblemsHaveAWitness) {
  const Problem p = make_backwards({.family = Family::kInfeasible, .cones = 6, .seed = 3}).problem;
  // y = 1 on both normals of each pair: H_n^T y = 0 and w_n . y < 0.
  Eigen::VectorXd y = Eigen::VectorXd::Zero(p.rows());
  for (int i = 0; i < p.cone_count(); ++i) y(p.start(i)) = 1.0;
  EXPECT_LE((p.H().transpose() * y).norm(), 1e-14);
  EXPECT_LT(p.w().dot(y), 0.0);
}

TEST(MadeBackwards, RankDeficientProblemsHaveMoreRowsThanDofs) {
  const Problem p =
      make_backwards({.family = Family::kRankDeficient, .cones = 30, .seed = 3}).problem;
  EXPECT_GT(p.features().rows_per_dof, 1.5);
}

}  // namespace
}  // namespace conebench::problems
