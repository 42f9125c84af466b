#include <gtest/gtest.h>

#include <algorithm>

#include "problems/made_backwards.h"
#include "problems/residual.h"
#include "solvers/monitor.h"
#include "solvers/registry.h"

namespace conebench::solvers {
namespace {

using problems::Family;
using problems::Problem;

TEST(InteriorPoint, QuasidefiniteFormFindsMadeSolutionsOfAllDimensions) {
  const Solver solver = make_solver("aclm-ipm[form=kkt]");
  for (const double theta_share : {0.0, 1.0}) {
    for (const std::vector<int>& dims :
         {std::vector<int>{1}, {2}, {3}, {6}, {4}, std::vector<int>{3, 1, 6, 2}}) {
      const Problem problem = problems::make_backwards({.cones = 12,
                                                        .dims = dims,
                                                        .mu_high = 0.5,
                                                        .theta_share = theta_share,
                                                        .cohesive_share = 0.5,
                                                        .seed = 21})
                                  .problem.shifted();
      const Result result = solver.solve(problem, {{.tol = 1e-8}, {}, nullptr});
      const double eta = problems::evaluate_eta(problem, result.r);
      EXPECT_LE(eta, 1e-8) << problem.name();
      EXPECT_EQ(result.status, Status::kConverged) << problem.name();
    }
  }
}

// Strong friction on fewer dofs than rows: of some of these the path to the solution has a fold.
TEST(InteriorPoint, BeginsAgainWhereItsFirstAttemptIsTrapped) {
  const Solver solver = make_solver("ipm");
  const auto says = [](const Result& result, const char* what) {
    return std::ranges::any_of(result.notes, [what](const std::string& note) {
      return note.find(what) != std::string::npos;
    });
  };
  int solved_again = 0;
  for (const double mass_ratio : {10.0, 1e4}) {
    for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
      const Problem problem = problems::make_backwards({.family = Family::kRankDeficient,
                                                        .cones = 40,
                                                        .mu_low = 0.75,
                                                        .mu_high = 1.5,
                                                        .mass_ratio = mass_ratio,
                                                        .seed = seed})
                                  .problem;
      const Result result =
          solver.solve(problem, {{.tol = 1e-7, .max_iterations = 60}, {}, nullptr});
      const bool again = says(result, "trapped") && !says(result, "aclm-ipm");
      if (again && problems::evaluate_eta(problem, result.r) <= 1e-7) ++solved_again;
    }
  }
  EXPECT_GE(solved_again, 1);
}

TEST(InteriorPoint, SolvesFromEveryGuess) {
  const Solver solver = make_solver("ipm");
  const problems::MadeProblem made = problems::make_backwards({.cones = 60, .seed = 3});
  const Eigen::VectorXd& solution = made.solutions[0];
  const Eigen::VectorXd noise = Eigen::VectorXd::Random(solution.size());
  for (const double share : {1e-9, 1e-3, 1.0, 1e6, 1e12}) {
    const Eigen::VectorXd guess = solution + share * solution.norm() * noise;
    const Result result =
        solver.solve(made.problem, {{.tol = 1e-7, .max_iterations = 60}, guess, nullptr});
    EXPECT_EQ(result.status, Status::kConverged) << share;
  }
  // One whose squares overflow has no eta; with its own test ipm leaves it behind all the same.
  const Stop own{.tol = 1e-7, .max_iterations = 60, .test = StopTest::kOwn};
  EXPECT_EQ(solver.solve(made.problem, {own, 1e160 * noise, nullptr}).status, Status::kConverged);
  // A guess that solves the problem is an answer.
  EXPECT_EQ(solver.solve(made.problem, {{.tol = 1e-7}, solution, nullptr}).iterations, 0);
}

// Where r_i = u_i = 0 the gap of an interior point closes as the square of eta: alone it would
// end near 1e-8.
TEST(InteriorPoint, SweepsSharpenWhatItCannot) {
  const Solver solver = make_solver("ipm");
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Problem problem = problems::make_backwards({.cones = 40, .seed = seed}).problem;
    const Result result =
        solver.solve(problem, {{.tol = 1e-10, .max_iterations = 60}, {}, nullptr});
    EXPECT_LE(problems::evaluate_eta(problem, result.r), 1e-10) << seed;
  }
}

// Sweeps bring an iterate near the tolerance to it: on the way to a tighter one it is not worth
// them.
TEST(InteriorPoint, NeedsFewerIterationsWhereItKnowsTheTolerance) {
  constexpr double kTol = 1e-5;
  const Solver solver = make_solver("ipm");
  std::int64_t asked = 0, passed = 0;
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    const Problem problem =
        problems::make_backwards({.family = Family::kRankDeficient, .cones = 40, .seed = seed})
            .problem;
    const Result result = solver.solve(problem, {{.tol = kTol}, {}, nullptr});
    ASSERT_EQ(result.status, Status::kConverged) << "seed " << seed;
    asked += result.iterations;
    const Stop tight{.tol = 1e-10, .max_iterations = 200};
    Monitor monitor(problem, tight);
    solver.solve(problem, {tight, {}, &monitor});
    const auto there = std::ranges::find_if(
        monitor.curve(), [](const CurvePoint& point) { return point.eta <= kTol; });
    ASSERT_NE(there, monitor.curve().end()) << "seed " << seed;
    passed += there->iteration;
  }
  EXPECT_LT(asked, passed);
}

}  // namespace
}  // namespace conebench::solvers
