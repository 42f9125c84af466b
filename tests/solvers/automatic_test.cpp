#include <gtest/gtest.h>

#include <random>

#include "problems/made_backwards.h"
#include "problems/residual.h"
#include "solvers/registry.h"

namespace conebench::solvers {
namespace {

// A lane may end its turn at a solution, between two looks at eta: sweeps find r = 0 of wedged
// cones that open exactly, and stop.
TEST(Automatic, EndsWhereALaneEndsAtASolution) {
  const Solver solver = make_solver("auto");
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (const std::uint64_t seed : {5, 10, 13, 14, 17}) {
    const problems::Problem problem =
        problems::make_backwards({.family = problems::Family::kSeveral, .cones = 3, .seed = seed})
            .problem;
    random.seed(7);
    normal.reset();
    for (int start = 0; start < 10; ++start) {
      const Eigen::VectorXd guess =
          Eigen::VectorXd::NullaryExpr(problem.rows(), [&] { return normal(random); });
      for (const StopTest test : {StopTest::kCommon, StopTest::kOwn}) {
        const Stop stop{.tol = 1e-8, .max_iterations = 20'000, .test = test};
        const Result result = solver.solve(problem, {stop, guess, nullptr});
        EXPECT_EQ(result.status, Status::kConverged) << seed << " from start " << start;
        EXPECT_LE(problems::evaluate_eta(problem, result.r), 1e-8);
      }
    }
  }
}

}  // namespace
}  // namespace conebench::solvers
