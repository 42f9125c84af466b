// What reactions do beyond their law, against closed forms.

#include "problems/excess_work.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>

#include "problems/error.h"
#include "problems/made_backwards.h"
#include "problems/residual.h"

namespace conebench::problems {
namespace {

using Eigen::Vector3d;

// A ball of 2 kg that falls on a floor at 3 m/s, sliding at 1 m/s, mu = 0.5: u = v.
Problem falling_ball() {
  const Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  return Problem(PrimalData{(2.0 * one).sparseView(), one.sparseView(), Vector3d(-6.0, 2.0, 0.0),
                            Vector3d::Zero()},
                 {Cone::coulomb(3, 0.5)}, {});
}

TEST(ExcessWork, IsZeroForTheBallThatIsStoppedAndSticks) {
  EXPECT_NEAR(excess_work(falling_ball(), Vector3d(6.0, -2.0, 0.0)), 0.0, 1e-15);
}

TEST(ExcessWork, OfAPushTooLargeIsWhatItPutsIn) {
  // r_n = 8 N s throws the ball up at 1 m/s: 8 N s x 1 m/s; friction stops the sliding.
  EXPECT_NEAR(excess_work(falling_ball(), Vector3d(8.0, -2.0, 0.0)), 8.0, 1e-14);
}

TEST(ExcessWork, OfAPushTooSmallIsWhatItTakes) {
  // r_n = 4 N s leaves the ball falling at 1 m/s.
  EXPECT_NEAR(excess_work(falling_ball(), Vector3d(4.0, -2.0, 0.0)), -4.0, 1e-14);
}

TEST(ExcessWork, OfMissingFrictionIsWhatFrictionWouldHaveTaken) {
  // Sliding on at 1 m/s without friction: mu r_n |u_t| = 0.5 x 6 x 1.
  EXPECT_NEAR(excess_work(falling_ball(), Vector3d(6.0, 0.0, 0.0)), 3.0, 1e-14);
}

TEST(ExcessWork, VanishesAtMadeSolutionsAndIsBoundedByTheResidualsWorkElsewhere) {
  for (const double theta : {1.0, 0.5, 0.0}) {
    const MadeProblem made = make_backwards(
        {.cones = 24, .dims = {3, 2, 6}, .theta_share = theta, .cohesive_share = 0.5});
    const Problem standard = made.problem.shifted();
    const Eigen::VectorXd& solution = made.solutions.front();
    const double scale = standard.q().norm() * solution.norm();
    EXPECT_NEAR(excess_work(standard, solution), 0.0, 1e-13 * scale);
    const Eigen::VectorXd r = 1.1 * solution;
    const Residual residual = evaluate_residual(standard, r);
    EXPECT_LE(std::abs(excess_work(standard, r)),
              residual.work.per_cone.sum() * (1.0 + 1e-12) + 1e-13 * scale);
  }
}

TEST(ExcessWork, WantsTheStandardProblemAndAnAnswerOfItsSize) {
  const Problem cohesive(PrimalData{Eigen::MatrixXd::Identity(3, 3).sparseView(),
                                    Eigen::MatrixXd::Identity(3, 3).sparseView(),
                                    Vector3d(-1, 0, 0), Vector3d::Zero()},
                         {Cone::coulomb(3, 0.5, 1.0)}, {});
  EXPECT_THROW(excess_work(cohesive, Vector3d::Zero()), InputError);
  EXPECT_THROW(excess_work(falling_ball(), Eigen::VectorXd::Zero(2)), InputError);
}

}  // namespace
}  // namespace conebench::problems
