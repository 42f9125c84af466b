// Siconos as a peer. Reported as skipped in a build without it.

#include "solvers/siconos.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "problems/made_backwards.h"
#include "problems/residual.h"

namespace conebench::solvers {
namespace {

using problems::Cone;
using problems::Problem;
using problems::ReducedData;
using testing::Contains;
using testing::HasSubstr;

class Siconos : public testing::Test {
 protected:
  void SetUp() override {
    if (siconos_methods().empty()) GTEST_SKIP() << "built without Siconos Numerics";
  }

  static std::vector<std::string> names() {
    std::vector<std::string> names;
    for (const Method& method : siconos_methods()) names.push_back(method.name);
    return names;
  }
};

// 2 kg on a slope, one step of 0.01 s from rest; the normal impulse is 0.1962 cos(slope) N s.
Problem block_on_slope(int dim, double slope_rad) {
  constexpr double kMass = 2.0, kKick = 9.81 * 0.01;
  Eigen::VectorXd free = Eigen::VectorXd::Zero(dim);
  free.head<2>() << -kKick * std::cos(slope_rad), kKick * std::sin(slope_rad);
  const Eigen::MatrixXd W = Eigen::MatrixXd::Identity(dim, dim) / kMass;
  return Problem(ReducedData{W.sparseView(), free}, {Cone::coulomb(dim, 0.5)}, {});
}

TEST_F(Siconos, BlockSticksOnAGentleSlopeAndSlidesOnASteepOne) {
  const double kick = 2.0 * 9.81 * 0.01;
  for (const std::string& name : names()) {
    if (make_solver(name).kind == Kind::kModel) continue;
    for (const auto& [slope, friction] :
         {std::pair{0.3, -std::sin(0.3)}, std::pair{0.9, -0.5 * std::cos(0.9)}}) {
      const Result result =
          make_solver(name).solve(block_on_slope(3, slope), {{.tol = 1e-8}, {}, nullptr});
      EXPECT_EQ(result.status, Status::kConverged) << name << " at " << slope;
      EXPECT_NEAR(result.r(0), kick * std::cos(slope), 1e-8) << name;
      EXPECT_NEAR(result.r(1), kick * friction, 1e-8) << name;
    }
  }
}

TEST_F(Siconos, GaussSeidelTakesTwoDimensionsToo) {
  const Result result =
      make_solver("siconos:nsgs").solve(block_on_slope(2, 0.9), {{.tol = 1e-8}, {}, nullptr});
  EXPECT_EQ(result.status, Status::kConverged);
  EXPECT_NEAR(result.r(1), -0.5 * result.r(0), 1e-8);
}

TEST_F(Siconos, SolvesMadeProblemsInBothFormsAndReportsItsIterations) {
  for (const bool reduced : {false, true}) {
    const Problem problem =
        problems::make_backwards({.cones = 30, .mu_high = 0.5, .reduced = reduced, .seed = 21})
            .problem;
    for (const char* name : {"siconos:nsgs", "siconos:nsgs-pli", "siconos:nsgs[error=light]",
                             "siconos:nsn-ac", "siconos:vi-eg", "siconos:prox", "siconos:admm"}) {
      const Result result =
          make_solver(name).solve(problem, {{.tol = 1e-7, .time_limit_s = 20.0}, {}, nullptr});
      EXPECT_EQ(result.status, Status::kConverged) << name;
      EXPECT_LE(problems::evaluate_eta(problem, result.r), 1e-7) << name;
      EXPECT_GT(result.iterations, 0) << name;
      EXPECT_GT(result.solve_s, 0.0) << name;
    }
  }
}

TEST_F(Siconos, OwnTestIsItsClaimAndMayBeLooserThanEta) {
  const Problem problem =
      problems::make_backwards({.cones = 30, .mu_high = 0.5, .seed = 21}).problem;
  const Result result = make_solver("siconos:nsgs")
                            .solve(problem, {{.tol = 1e-4, .test = StopTest::kOwn}, {}, nullptr});
  EXPECT_EQ(result.status, Status::kConverged);
  EXPECT_TRUE(result.notes.empty());
  EXPECT_LE(problems::evaluate_residual(problem, result.r).siconos, 1.1e-4);
}

TEST_F(Siconos, GuessIsWhereItStarts) {
  const auto made = problems::make_backwards({.cones = 30, .mu_high = 0.5, .seed = 21});
  const Stop stop{.tol = 1e-6, .test = StopTest::kOwn};
  const Solver solver = make_solver("siconos:nsgs");
  const Result cold = solver.solve(made.problem, {stop, {}, nullptr});
  const Result warm = solver.solve(made.problem, {stop, made.solutions[0], nullptr});
  EXPECT_LE(warm.iterations, 1);
  EXPECT_GT(cold.iterations, warm.iterations);
}

TEST_F(Siconos, SaysWhatItRefuses) {
  const Solver solver = make_solver("siconos:nsn-ac");
  auto made = [](std::vector<int> dims, double theta_share) {
    return problems::make_backwards({.dims = std::move(dims), .theta_share = theta_share}).problem;
  };
  EXPECT_THAT(solver.refuses(made({6}, 1.0)).value_or(""), HasSubstr("dimension 6"));
  EXPECT_THAT(solver.refuses(made({2}, 1.0)).value_or(""), HasSubstr("dimension 2"));
  EXPECT_THAT(solver.refuses(made({3, 1}, 1.0)).value_or(""), HasSubstr("mixed dimensions"));
  EXPECT_THAT(solver.refuses(made({3}, 0.5)).value_or(""), HasSubstr("theta != mu"));
  EXPECT_FALSE(make_solver("siconos:soclcp").refuses(made({3}, 0.0)));
}

TEST_F(Siconos, ModelIsExactForTheAssociatedLaw) {
  const Problem problem =
      problems::make_backwards({.cones = 15, .theta_share = 0.0, .seed = 5}).problem;
  const Result result = make_solver("siconos:soclcp").solve(problem, {{.tol = 1e-8}, {}, nullptr});
  EXPECT_EQ(result.status, Status::kConverged);
  EXPECT_LE(problems::evaluate_eta(problem, result.r), 1e-6);
}

TEST_F(Siconos, IsKilledAtTheTimeLimitAndReturnsWhatItHas) {
  const Problem problem =
      problems::make_backwards({.family = problems::Family::kInfeasible, .cones = 40, .seed = 3})
          .problem;
  const Result result =
      make_solver("siconos:nsgs").solve(problem, {{.tol = 1e-9, .time_limit_s = 0.2}, {}, nullptr});
  EXPECT_NE(result.status, Status::kConverged);
  EXPECT_EQ(result.r.size(), problem.rows());
  EXPECT_FALSE(result.notes.empty());
}

TEST_F(Siconos, LimitOfIterationsIsKept) {
  const Problem problem =
      problems::make_backwards({.cones = 30, .mu_high = 0.5, .seed = 24}).problem;
  const Result result =
      make_solver("siconos:nsgs[max_iterations=3]").solve(problem, {{.tol = 1e-12}, {}, nullptr});
  EXPECT_EQ(result.status, Status::kIterationLimit);
  EXPECT_LE(result.iterations, 4);  // Siconos may count one more
}

TEST_F(Siconos, EmptyProblemIsSolved) {
  const Problem empty(ReducedData{problems::SparseMatrix(0, 0), Eigen::VectorXd(0)}, {}, {});
  for (const std::string& name : names()) {
    EXPECT_EQ(make_solver(name).solve(empty, {}).status, Status::kConverged) << name;
  }
}

}  // namespace
}  // namespace conebench::solvers
