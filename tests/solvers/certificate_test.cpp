#include "solvers/certificate.h"

#include <gtest/gtest.h>

#include "problems/made_backwards.h"
#include "solvers/registry.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Family;
using problems::PrimalData;
using problems::Problem;
using problems::SparseMatrix;

constexpr double kTimeLimit = 10.0;

SparseMatrix sparse(const Eigen::MatrixXd& dense) { return dense.sparseView(); }

// A unit mass between two walls that approach it at these speeds from both sides.
Problem between_walls(double from_below, double from_above, Cone cone) {
  Eigen::MatrixXd H(2 * cone.dim, 3);
  Eigen::VectorXd w = Eigen::VectorXd::Zero(2 * cone.dim);
  const Eigen::MatrixXd rows = Eigen::Matrix3d::Identity().topRows(cone.dim);
  H << rows, -rows;
  w(0) = -from_below;
  w(cone.dim) = -from_above;
  return Problem(
      PrimalData{sparse(Eigen::Matrix3d::Identity()), sparse(H), Eigen::Vector3d(0.3, 0.1, 0.0), w},
      {cone, cone}, {});
}

TEST(Certificate, WallsThatCloseInLeaveNoSolution) {
  for (const Cone& cone : {Cone::coulomb(1, 0.0), Cone::coulomb(3, 0.5), Cone::coulomb(2, 0.3, 1.0),
                           Cone::associated(3, 0.5), Cone{3, 0.5, 0.0, 0.2}}) {
    const Problem problem = between_walls(1.0, 0.5, cone);
    const Certificate found = certify(problem, kTimeLimit);
    ASSERT_EQ(found.verdict, Existence::kNone) << found.text;
    EXPECT_TRUE(proves_infeasible(problem, found.y));
    EXPECT_GE(found.margin, kProof);
    EXPECT_NEAR(found.y(0), found.y(cone.dim), 1e-6 * found.y(0)) << "both walls push alike";
    EXPECT_FALSE(proves_infeasible(problem, -found.y));
    EXPECT_FALSE(proves_infeasible(problem, Eigen::VectorXd::Unit(problem.rows(), 0)));
    EXPECT_FALSE(proves_infeasible(problem, Eigen::VectorXd::Zero(problem.rows())));
    EXPECT_FALSE(proves_infeasible(problem, Eigen::VectorXd()));
  }
}

TEST(Certificate, WallsThatPartLeaveRoom) {
  const Certificate found = certify(between_walls(1.0, -1.5, Cone::coulomb(3, 0.5)), kTimeLimit);
  ASSERT_EQ(found.verdict, Existence::kExists) << found.text;
  EXPECT_GT(found.margin, 0.0);
}

// u_n = 0 is forced at both walls: no velocity is strictly inside, none is excluded either.
TEST(Certificate, WallsThatMoveAlikeAreUndecided) {
  const Problem problem = between_walls(1.0, -1.0, Cone::coulomb(3, 0.5));
  const Certificate found = certify(problem, kTimeLimit);
  EXPECT_EQ(found.verdict, Existence::kUnknown) << found.text;
  InfeasibilitySearch search(problem);
  Iteration::State state = search.advance();
  while (state == Iteration::State::kRunning) state = search.advance();
  EXPECT_NE(state, Iteration::State::kInfeasible);
}

TEST(Certificate, NoForceNoClosingIsSolvedByNothing) {
  const Problem problem(
      PrimalData{sparse(Eigen::Matrix3d::Identity()), sparse(Eigen::Matrix3d::Identity()),
                 Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()},
      {Cone::coulomb(3, 0.5)}, {});
  EXPECT_EQ(certify(problem, kTimeLimit).verdict, Existence::kExists);
}

TEST(Certificate, ProvesTheInfeasibleFamily) {
  for (const double theta_share : {1.0, 0.5, 0.0}) {
    for (const bool reduced : {false, true}) {
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const Problem problem = problems::make_backwards({.family = Family::kInfeasible,
                                                          .cones = 30,
                                                          .dims = {3, 1, 2},
                                                          .theta_share = theta_share,
                                                          .cohesive_share = 0.3,
                                                          .reduced = reduced,
                                                          .seed = seed})
                                    .problem;
        const Certificate found = certify(problem, kTimeLimit);
        EXPECT_EQ(found.verdict, Existence::kNone)
            << problem.name() << " theta share " << theta_share << ": " << found.text;
        EXPECT_TRUE(proves_infeasible(problem.shifted(), found.y)) << "cohesion changes nothing";
      }
    }
  }
}

TEST(Certificate, NeverCallsASolvableProblemInfeasible) {
  for (const Family family :
       {Family::kGeneric, Family::kRankDeficient, Family::kSingularBlock, Family::kSeveral}) {
    for (const bool reduced : {false, true}) {
      for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const Problem problem =
            problems::make_backwards(
                {.family = family, .cones = 24, .reduced = reduced, .seed = seed})
                .problem;
        const Certificate found = certify(problem, kTimeLimit);
        EXPECT_NE(found.verdict, Existence::kNone) << problem.name();
        if (family == Family::kGeneric || family == Family::kSeveral) {
          EXPECT_EQ(found.verdict, Existence::kExists) << problem.name() << ": " << found.text;
        }
        if (found.margin > 0.0) {
          EXPECT_EQ(found.margin, interior_margin(problem, found.r)) << problem.name();
        }
      }
    }
  }
}

TEST(Certificate, MethodsEndWithTheProof) {
  for (const double theta_share : {1.0, 0.0}) {
    for (const bool reduced : {false, true}) {
      const Problem problem = problems::make_backwards({.family = Family::kInfeasible,
                                                        .theta_share = theta_share,
                                                        .reduced = reduced,
                                                        .seed = 3})
                                  .problem;
      for (const char* name : {"aclm", "aclm-ipm", "ipm", "auto"}) {
        const Result result =
            make_solver(name).solve(problem, {.stop = {.time_limit_s = kTimeLimit}});
        EXPECT_EQ(result.status, Status::kInfeasible) << name << " " << to_string(result.status);
        EXPECT_TRUE(proves_infeasible(problem, result.certificate)) << name << problem.name();
      }
    }
  }
}

// The solution v = (1, 2 / delta) is fast: existence is what is said, and what is said against it
// is no more than that it is fast. The data's own velocity is (1 / W_11 + 1 / W_22)^(1/2).
TEST(Certificate, FastSolutionsExist) {
  for (const double delta : {1e-2, 1e-6}) {
    Eigen::Matrix2d H;
    H << 1.0, 0.0, -1.0, delta;
    const Problem problem(PrimalData{sparse(Eigen::Matrix2d::Identity()), sparse(H),
                                     Eigen::Vector2d::Zero(), Eigen::Vector2d(-1.0, -1.0)},
                          {Cone::coulomb(1, 0.0), Cone::coulomb(1, 0.0)}, {});
    const Certificate found = certify(problem, kTimeLimit);
    if (delta == 1e-2) {
      EXPECT_EQ(found.verdict, Existence::kExists);
    }
    const double margin = infeasibility_margin(problem, Eigen::Vector2d(1.0, 1.0));
    EXPECT_NEAR(margin, std::hypot(1.0, 2.0 / delta) / std::sqrt(2.0), 0.1 * margin);
    EXPECT_LE(margin, std::hypot(1.0, 2.0 / delta) / std::sqrt(2.0) * (1.0 + delta));
  }
}

// In the reduced form with W far from symmetric no velocity stands behind W r + q.
TEST(Certificate, NothingIsProvedOfAnAsymmetricMatrix) {
  Eigen::Matrix2d W;
  W << 0.0, -0.01, 0.01, 1.0;
  const Problem problem(problems::ReducedData{sparse(W), Eigen::Vector2d(-1.0, 0.0)},
                        {Cone::coulomb(1, 0.0), Cone::coulomb(1, 0.0)}, {});
  EXPECT_LT(interior_margin(problem, Eigen::Vector2d(3e4, -200.0)), 0.0);
  EXPECT_EQ(infeasibility_margin(problem, Eigen::Vector2d(1.0, 0.0)), 0.0);
}

}  // namespace
}  // namespace conebench::solvers
