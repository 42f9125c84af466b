// NLopt on the convex problem inside the fixed point: small problems, modest accuracy.

#include <gtest/gtest.h>

#include "solvers/monitor.h"
#include "solvers/nlopt_convex.h"
#include "tests/solvers/convex_check.h"

namespace conebench::solvers {
namespace {

using problems::Problem;
using Algorithm = NloptSettings::Algorithm;

Problem made(int cones, bool reduced, double theta_share = 0.0) {
  return problems::make_backwards({.cones = cones,
                                   .dims = {3, 1, 2},
                                   .mu_high = 0.5,
                                   .theta_share = theta_share,
                                   .mass_ratio = 2.0,
                                   .reduced = reduced,
                                   .seed = 21})
      .problem;
}

TEST(NloptConvex, SlsqpFindsTheConvexSolution) {
  for (const bool reduced : {false, true}) {
    const Problem problem = made(9, reduced);
    const auto convex = make_nlopt_convex(problem, {});
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(problem.cone_count());
    EXPECT_LE(solved_to(problem, none, *convex, 1e-6, 30), 1e-6);
    EXPECT_LE(solved_to(problem, random_shift(problem), *convex, 1e-6, 30), 1e-6);
  }
}

// First-order tails: what these reach in thirty runs, not what they promise.
TEST(NloptConvex, TheOthersComeCloseToIt) {
  for (const Algorithm algorithm : {Algorithm::kMma, Algorithm::kCcsaq, Algorithm::kAuglag}) {
    const Problem problem = made(3, false);
    const auto convex = make_nlopt_convex(problem, {algorithm});
    EXPECT_LE(solved_to(problem, random_shift(problem), *convex, 1e-4, 30), 1e-3)
        << static_cast<int>(algorithm);
  }
}

TEST(Nlopt, SolvesASmallCoulombProblem) {
  const Problem problem = made(6, false, 1.0);
  const Request request{{.tol = 1e-6, .max_iterations = 500}, {}, nullptr};
  EXPECT_EQ(make_solver("nlopt").solve(problem, request).status, Status::kConverged);
}

TEST(Nlopt, RefusesWhatIsTooLargeAndNamesTheLimit) {
  const Problem problem = made(200, false);
  for (const char* name : {"nlopt", "nlopt[algorithm=mma]", "nlopt[algorithm=ccsaq]"}) {
    const auto why = make_solver(name).refuses(problem);
    ASSERT_TRUE(why.has_value()) << name;
    EXPECT_NE(why->find("300"), std::string::npos);
    EXPECT_NE(why->find(std::to_string(problem.rows())), std::string::npos);
  }
  EXPECT_TRUE(make_solver("nlopt[algorithm=auglag]").supports(problem));
}

}  // namespace
}  // namespace conebench::solvers
