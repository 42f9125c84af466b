#include "solvers/monitor.h"

#include <gtest/gtest.h>

#include <thread>

#include "problems/error.h"
#include "problems/made_backwards.h"

namespace conebench::solvers {
namespace {

using problems::MadeProblem;

const MadeProblem& made() {
  static const MadeProblem kMade = problems::make_backwards({.cones = 6, .seed = 2});
  return kMade;
}

TEST(Monitor, StopsAtTheSolutionAndKeepsTheBestIterate) {
  Monitor monitor(made().problem, {.tol = 1e-10});
  const Eigen::VectorXd& solution = made().solutions[0];
  EXPECT_EQ(monitor.check(0, Eigen::VectorXd::Zero(solution.size())), Verdict::kGoOn);
  EXPECT_EQ(monitor.check(1, 0.9 * solution), Verdict::kGoOn);
  EXPECT_EQ(monitor.check(2, solution), Verdict::kStop);
  EXPECT_EQ(monitor.status(), Status::kConverged);
  EXPECT_EQ(monitor.best(), solution);
  ASSERT_EQ(monitor.curve().size(), 3u);
  EXPECT_DOUBLE_EQ(monitor.curve()[0].eta, 1.0);
  EXPECT_LE(monitor.curve()[2].eta, 1e-10);
}

TEST(Monitor, KeepsTheBestIterateWhenLaterOnesAreWorse) {
  Monitor monitor(made().problem, {.tol = 1e-10, .max_iterations = 2});
  const Eigen::VectorXd& solution = made().solutions[0];
  EXPECT_EQ(monitor.check(0, 0.99 * solution), Verdict::kGoOn);
  EXPECT_EQ(monitor.check(1, 7.0 * solution), Verdict::kGoOn);
  EXPECT_EQ(monitor.check(2, 5.0 * solution), Verdict::kStop);
  EXPECT_EQ(monitor.status(), Status::kIterationLimit);
  EXPECT_EQ(monitor.best(), 0.99 * solution);
}

TEST(Monitor, CallsANaNDiverged) {
  Monitor monitor(made().problem, {});
  EXPECT_EQ(monitor.check(0, Eigen::VectorXd::Constant(18, NAN)), Verdict::kStop);
  EXPECT_EQ(monitor.status(), Status::kDiverged);
}

TEST(Monitor, StopsAtTheTimeLimitAndDoesNotCountItsOwnWork) {
  const MadeProblem large = problems::make_backwards({.cones = 20000, .seed = 2});
  Monitor monitor(large.problem, {.time_limit_s = 3600.0});
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(large.problem.rows());
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < 20; ++k) monitor.check(k, zero);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  EXPECT_LT(monitor.elapsed_s(), 0.5 * wall.count());

  Monitor hurried(made().problem, {.time_limit_s = 1e-3});
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  EXPECT_EQ(hurried.check(5, Eigen::VectorXd::Zero(18)), Verdict::kStop);
  EXPECT_EQ(hurried.status(), Status::kTimeLimit);
}

TEST(Monitor, LooksAtEveryIterationUpToFiftyThenEveryTwoPercent) {
  Monitor monitor(made().problem, {.tol = 1e-300});
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(18);
  for (int k = 0; k <= 1000; ++k) monitor.check(k, zero);
  for (std::size_t k = 0; k < 50; ++k) {
    EXPECT_EQ(monitor.curve()[k].iteration, static_cast<std::int64_t>(k));
  }
  EXPECT_LT(monitor.curve().size(), 220u);
}

TEST(Monitor, LeavesJudgementToTheMethodWhenTheTestIsItsOwn) {
  Monitor monitor(made().problem, {.test = StopTest::kOwn});
  EXPECT_EQ(monitor.check(0, made().solutions[0]), Verdict::kGoOn);
  EXPECT_TRUE(monitor.curve().empty());
}

TEST(Monitor, ShowsTheTimeThatAnotherProcessMeasured) {
  Monitor monitor(made().problem, {});
  monitor.set_clock(100.0, 2000.0);
  EXPECT_EQ(monitor.setup_s(), 100.0);
  EXPECT_GE(monitor.elapsed_s(), 2100.0 - 1e-6);
  EXPECT_LT(monitor.elapsed_s(), 2110.0);
}

TEST(Monitor, RefusesAMeaninglessStop) {
  EXPECT_THROW(Monitor(made().problem, {.tol = 0.0}), problems::InputError);
  EXPECT_THROW(Monitor(made().problem, {.time_limit_s = -1.0}), problems::InputError);
}

}  // namespace
}  // namespace conebench::solvers
