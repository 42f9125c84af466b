// Ipopt on the De Saxce gap, and on the convex problem inside the fixed point.

#include <gtest/gtest.h>

#include <stdexcept>

#include "problems/residual.h"
#include "solvers/cone_program.h"
#include "solvers/ipopt_convex.h"
#include "tests/solvers/convex_check.h"

namespace conebench::solvers {
namespace {

using problems::Problem;
using problems::SparseMatrix;

Problem made(double theta_share, bool reduced, std::vector<int> dims = {3, 1, 6, 2}) {
  return problems::make_backwards({.cones = 12,
                                   .dims = std::move(dims),
                                   .mu_high = 0.5,
                                   .theta_share = theta_share,
                                   .reduced = reduced,
                                   .seed = 21})
      .problem;
}

// min (a - 2)^2 / 2 + c over |(b, c)| <= a with b = 1: the cone is active at c = -sqrt(a^2 - 1),
// a - 2 = a / sqrt(a^2 - 1).
ConeProgram known_program() {
  SparseMatrix Q(3, 3), A(1, 3);
  Q.insert(0, 0) = 1.0;
  A.insert(0, 1) = 1.0;
  ConeProgram program{.Q = Q,
                      .c = Eigen::Vector3d(-2.0, 0.0, 1.0),
                      .A = A,
                      .b = Eigen::VectorXd::Ones(1),
                      .lower = Eigen::Vector3d(0.0, -1e30, -1e30),
                      .upper = Eigen::Vector3d::Constant(1e30)};
  program.cones.push_back({0, 1, 2, 1.0});
  return program;
}

TEST(ConeProgramTest, FindsAKnownMinimum) {
  ProgramPoint point{Eigen::Vector3d(1.0, 0.0, 0.0)};
  const auto go_on = [](const Eigen::VectorXd&) { return true; };
  ASSERT_EQ(run_ipopt(known_program(), {.tol = 1e-10}, point, go_on), IpoptEnd::kSolved);
  const double a = point.x(0);
  EXPECT_NEAR(a - 2.0, a / std::sqrt(a * a - 1.0), 1e-8);
  EXPECT_NEAR(point.x(1), 1.0, 1e-12);
  EXPECT_NEAR(point.x(2), -std::sqrt(a * a - 1.0), 1e-8);
}

TEST(ConeProgramTest, StopsWhenTheWatcherSaysSoAndPassesOnWhatItThrows) {
  ProgramPoint point{Eigen::Vector3d(1.0, 0.0, 0.0)};
  int seen = 0;
  const Watch three = [&seen](const Eigen::VectorXd&) { return ++seen < 3; };
  EXPECT_EQ(run_ipopt(known_program(), {}, point, three), IpoptEnd::kStopped);
  EXPECT_EQ(seen, 3);
  const Watch thrower = [](const Eigen::VectorXd&) -> bool { throw std::runtime_error("stop"); };
  EXPECT_THROW(run_ipopt(known_program(), {}, point, thrower), std::runtime_error);
}

TEST(Ipopt, SolvesEveryFlowLawInBothForms) {
  for (const double theta_share : {0.0, 0.5, 1.0}) {
    for (const bool reduced : {false, true}) {
      const Problem problem = made(theta_share, reduced);
      const Result result = make_solver("ipopt").solve(problem, {{.tol = 1e-8}, {}, nullptr});
      EXPECT_EQ(result.status, Status::kConverged) << theta_share << reduced;
      EXPECT_LE(problems::evaluate_eta(problem, result.r), 1e-8);
      EXPECT_EQ(result.notes.size(), 1u);
    }
  }
}

// Rates 2^10 and forces 2^20 times larger in number, exactly: Ipopt gets the same numbers
// (dimensionless_test.cpp). Its linear algebra rounds as memory happens to be aligned, so that two
// runs agree to their tolerance only.
TEST(Ipopt, UnitsDoNotMatter) {
  const Problem problem = made(1.0, true, {3});
  const SparseMatrix W = problem.W() * 0x1p-10;
  const Problem other(problems::ReducedData{W, 0x1p10 * problem.q()},
                      {problem.cones().begin(), problem.cones().end()}, {});
  constexpr double kTol = 1e-6;
  const Request request{{.tol = kTol}, {}, nullptr};
  const Result first = make_solver("ipopt").solve(problem, request);
  const Result second = make_solver("ipopt").solve(other, request);
  ASSERT_EQ(first.status, Status::kConverged);
  EXPECT_EQ(second.status, Status::kConverged);
  EXPECT_LE(problems::evaluate_eta(problem, second.r * 0x1p-20), kTol);
  EXPECT_LE((second.r * 0x1p-20 - first.r).norm(), kTol * first.r.norm());
}

TEST(IpoptConvex, FindsTheAssociatedProblemsSolution) {
  for (const bool reduced : {false, true}) {
    const Problem problem = made(0.0, reduced);
    const auto convex = make_ipopt_convex(problem);
    const Eigen::VectorXd none = Eigen::VectorXd::Zero(problem.cone_count());
    EXPECT_LE(solved_to(problem, none, *convex, 1e-9, 5), 1e-9);
    EXPECT_EQ(convex->u(), problem.rate(convex->r()));
    // Posed anew, with another shift.
    EXPECT_LE(solved_to(problem, random_shift(problem), *convex, 1e-9, 5), 1e-9);
  }
}

TEST(IpoptConvex, SaysWhenItCannotDoBetter) {
  const Problem problem = made(0.0, false);
  const auto convex = make_ipopt_convex(problem);
  solved_to(problem, random_shift(problem), *convex, 1e-30, 20);
  EXPECT_EQ(convex->advance(1e-30), Iteration::State::kStalled);
  EXPECT_LE(convex->error(), 1e-9);
}

}  // namespace
}  // namespace conebench::solvers
