#include "harness/timing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <ctime>
#include <deque>
#include <limits>

#include "harness/allocations.h"
#include "problems/error.h"
#include "test_solvers.h"

namespace conebench::harness {
namespace {

using solvers::Request;
using solvers::Result;
using solvers::Status;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr double kUnknown = std::numeric_limits<double>::infinity();

// A solver whose clock shows what the test says, and which counts its solves.
class Scripted {
 public:
  explicit Scripted(std::deque<double> solve_s, double setup_s = 0.0)
      : solve_s_(std::move(solve_s)), setup_s_(setup_s) {}

  solvers::Solver solver() {
    solvers::Solver solver = honest_solver();
    solver.solve = [this](const problems::Problem&, const Request&) {
      Result result;
      result.status = Status::kConverged;
      result.r = Eigen::Vector3d(1.0, -0.25, 0.0);
      result.setup_s = setup_s_;
      result.solve_s = solve_s_.front();
      solve_s_.push_back(solve_s_.front());
      solve_s_.pop_front();
      ++solves_;
      return result;
    };
    return solver;
  }

  std::int64_t solves() const { return solves_; }

 private:
  std::deque<double> solve_s_;
  double setup_s_;
  std::int64_t solves_ = 0;
};

TimedSolves time_one_contact(const solvers::Solver& solver, const Repeats& repeats = {},
                             const solvers::Stop& stop = {}) {
  return time_solves(solver, one_contact(), {}, stop, repeats);
}

double seconds_of_processor() {
  return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

void spin(double seconds) {
  const double end_s = seconds_of_processor() + seconds;
  while (seconds_of_processor() < end_s) {
  }
}

TEST(Timing, OneSolveIsExactlyOneSolve) {
  Scripted scripted({0.25}, 0.125);
  const TimedSolves timed = time_one_contact(scripted.solver());
  EXPECT_EQ(scripted.solves(), 1);
  EXPECT_EQ(timed.solves, 1);
  EXPECT_EQ(timed.setup_s, 0.125);
  EXPECT_EQ(timed.solve_s, 0.25);
  EXPECT_EQ(timed.spread, kUnknown);
  EXPECT_EQ(timed.result.status, Status::kConverged);
  EXPECT_EQ(timed.result.r, Eigen::VectorXd(Eigen::Vector3d(1.0, -0.25, 0.0)));
}

TEST(Timing, EqualTimesAreKnownAfterSixSamples) {
  Scripted scripted({0.25}, 0.125);
  const TimedSolves timed = time_one_contact(scripted.solver(), {.by_confidence = true});
  EXPECT_EQ(timed.solves, 6);
  EXPECT_EQ(scripted.solves(), 7);  // and one to warm up
  EXPECT_DOUBLE_EQ(timed.setup_s, 0.125);
  EXPECT_DOUBLE_EQ(timed.solve_s, 0.25);
  EXPECT_DOUBLE_EQ(timed.spread, 0.0);
}

TEST(Timing, TheTimeOfTheWarmUpDoesNotCount) {
  Scripted scripted({100.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0});
  const TimedSolves timed =
      time_one_contact(scripted.solver(), {.by_confidence = true, .spread_goal = 1e-9, .most = 6});
  EXPECT_EQ(timed.solves, 6);
  EXPECT_DOUBLE_EQ(timed.solve_s, 3.5);
  EXPECT_DOUBLE_EQ(timed.spread, 0.5 * (6.0 - 1.0) / 3.5);
}

TEST(Timing, ShortSolvesAreBatched) {
  constexpr double kShort_s = 1e-5;
  Scripted scripted({kShort_s});
  const TimedSolves timed = time_one_contact(scripted.solver(), {.by_confidence = true});
  EXPECT_GE(static_cast<double>(timed.solves) * kShort_s, 6.0 * kSample_s * (1.0 - 1e-9));
  EXPECT_GT(scripted.solves(), timed.solves);
  EXPECT_NEAR(timed.solve_s, kShort_s, 1e-12);
  EXPECT_NEAR(timed.spread, 0.0, 1e-9);
}

TEST(Timing, NoMoreThanTheGivenNumberOfSamples) {
  Scripted scripted({1.0, 2.0});
  const TimedSolves timed =
      time_one_contact(scripted.solver(), {.by_confidence = true, .spread_goal = 1e-9, .most = 17});
  EXPECT_EQ(timed.solves, 17);
}

TEST(Timing, ASolveOfMoreThanHalfTheBudgetIsNotDoneTwice) {
  std::int64_t solves = 0;
  solvers::Solver slow = honest_solver();
  slow.solve = [&, honest = slow.solve](const problems::Problem& p, const Request& request) {
    Result result = honest(p, request);
    ::usleep(60'000);
    result.solve_s = 0.06;
    ++solves;
    return result;
  };
  const TimedSolves timed = time_one_contact(slow, {.by_confidence = true, .budget_s = 0.1});
  EXPECT_EQ(solves, 1);
  EXPECT_EQ(timed.solves, 1);
  EXPECT_EQ(timed.solve_s, 0.06);
  EXPECT_EQ(timed.spread, kUnknown);
}

TEST(Timing, TheBudgetEndsABatchThatTheSolversClockWouldNot) {
  solvers::Solver odd = honest_solver();  // claims a nanosecond, takes a millisecond
  odd.solve = [honest = odd.solve](const problems::Problem& p, const Request& request) {
    Result result = honest(p, request);
    ::usleep(1000);
    result.solve_s = 1e-9;
    return result;
  };
  const auto start = std::chrono::steady_clock::now();
  const TimedSolves timed = time_one_contact(odd, {.by_confidence = true, .budget_s = 0.1});
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(1));
  EXPECT_EQ(timed.solve_s, 1e-9);
}

TEST(Timing, ASolverThatNeverStartedItsClockIsAskedOnce) {
  Scripted scripted({0.0});
  EXPECT_EQ(time_one_contact(scripted.solver(), {.by_confidence = true}).solves, 1);
  EXPECT_EQ(scripted.solves(), 1);
}

TEST(Timing, DeterministicAnswersGetNoNote) {
  Scripted scripted({0.25});
  const TimedSolves timed = time_one_contact(scripted.solver(), {.by_confidence = true});
  EXPECT_THAT(timed.result.notes, IsEmpty());
}

// A solver whose answers differ in the last bit of one entry.
solvers::Solver fickle(Status status, int& solves) {
  solvers::Solver solver = honest_solver();
  solver.solve = [status, &solves, honest = solver.solve](const problems::Problem& p,
                                                          const Request& request) {
    Result result = honest(p, request);
    result.status = status;
    result.solve_s = 0.25;
    if (++solves % 2 == 0) result.r(0) = std::nextafter(result.r(0), 2.0);
    return result;
  };
  return solver;
}

TEST(Timing, AnAnswerThatDiffersInTheLastBitIsNoted) {
  int solves = 0;
  const TimedSolves timed =
      time_one_contact(fickle(Status::kConverged, solves), {.by_confidence = true});
  EXPECT_THAT(timed.result.notes, ElementsAre(HasSubstr("not deterministic")));
  EXPECT_EQ(timed.result.r(0), 1.0) << "the first answer is the one that counts";
}

TEST(Timing, AtTheTimeLimitAnswersMayDiffer) {
  int solves = 0;
  const TimedSolves timed =
      time_one_contact(fickle(Status::kTimeLimit, solves), {.by_confidence = true});
  EXPECT_GT(solves, 1);
  EXPECT_THAT(timed.result.notes, IsEmpty());
}

// Asks the monitor `looks` times about zero, which is no solution.
solvers::Solver looker(int looks) {
  solvers::Solver solver = honest_solver();
  solver.solve = [looks](const problems::Problem& standard, const Request& request) {
    Result result;
    result.r = Eigen::VectorXd::Zero(standard.rows());
    for (int i = 0; i < looks; ++i) request.monitor->check(i, result.r);
    result.status = request.monitor->status();
    result.solve_s = request.monitor->elapsed_s();
    return result;
  };
  return solver;
}

TEST(Timing, TheCurveIsThatOfTheFirstSolve) {
  const TimedSolves timed =
      time_one_contact(looker(20), {.by_confidence = true}, {.test = solvers::StopTest::kCommon});
  ASSERT_EQ(timed.curve.size(), 20u);
  EXPECT_EQ(timed.curve.back().iteration, 19);
  EXPECT_NEAR(timed.curve.back().eta, 1.0, 1e-12);
}

// A ranking takes its times from the curve: those of a slow first solve would count after all.
TEST(Timing, TheCurvesTimesAreInProportionToTheMedians) {
  int solves = 0;
  solvers::Solver solver = honest_solver();
  solver.solve = [&](const problems::Problem& standard, const Request& request) {
    Result result;
    result.r = Eigen::VectorXd::Zero(standard.rows());
    result.solve_s = solves++ == 0 ? 4.0 : 1.0;
    for (const int half : {1, 2}) {
      request.monitor->set_clock(0.0, 0.5 * half * result.solve_s);
      request.monitor->check(half, result.r);
    }
    return result;
  };
  const TimedSolves timed = time_one_contact(solver, {.by_confidence = true});
  EXPECT_EQ(timed.solve_s, 1.0);
  ASSERT_EQ(timed.curve.size(), 2u);
  EXPECT_NEAR(timed.curve[0].time_s, 0.5, 0.01);
  EXPECT_NEAR(timed.curve[1].time_s, 1.0, 0.01);
}

TEST(Timing, TheGuessAndTheRuleReachTheSolver) {
  const Eigen::VectorXd guess = Eigen::Vector3d(3.0, 2.0, 1.0);
  solvers::Solver solver = honest_solver();
  solver.solve = [&](const problems::Problem&, const Request& request) {
    EXPECT_EQ(request.guess, guess);
    EXPECT_EQ(request.stop.tol, 1e-3);
    Result result;
    result.r = request.guess;
    result.solve_s = 0.25;
    return result;
  };
  EXPECT_EQ(time_solves(solver, one_contact(), guess, {.tol = 1e-3}, {}).result.r, guess);
}

TEST(Timing, AllocationsAreThoseOfOneSolve) {
  if (!allocations_are_counted()) GTEST_SKIP() << "not counted under sanitizers";
  const auto allocations = [](const solvers::Solver& solver, bool by_confidence) {
    return time_one_contact(solver, {.by_confidence = by_confidence}).allocations;
  };
  const auto with_blocks = [](int blocks) {
    solvers::Solver solver = honest_solver();
    solver.solve = [blocks, honest = solver.solve](const problems::Problem& p, const Request& q) {
      Result result = honest(p, q);
      result.solve_s = 0.25;
      for (int i = 0; i < blocks; ++i) {
        void* volatile block = std::malloc(64);
        std::free(block);
      }
      return result;
    };
    return solver;
  };
  const std::uint64_t without = allocations(with_blocks(0), false);
  EXPECT_EQ(allocations(with_blocks(1000), false), without + 1000);
  EXPECT_EQ(allocations(with_blocks(1000), true), without + 1000);
}

TEST(Timing, LooksAtTheResidualAreNoAllocationsOfTheSolver) {
  if (!allocations_are_counted()) GTEST_SKIP() << "not counted under sanitizers";
  EXPECT_EQ(time_one_contact(looker(1)).allocations, time_one_contact(looker(40)).allocations);
}

TEST(Timing, ProcessorTimeIsThatOfTheSolveAndOfWhatItWaitedFor) {
  solvers::Solver solver = honest_solver();
  solver.solve = [honest = solver.solve](const problems::Problem& p, const Request& request) {
    spin(0.1);
    const pid_t child = ::fork();
    if (child == 0) {
      spin(0.1);
      ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
    ::usleep(100'000);  // costs nothing
    return honest(p, request);
  };
  const TimedSolves timed = time_one_contact(solver);
  EXPECT_GE(timed.cpu_s, 0.19);
  EXPECT_LT(timed.cpu_s, 0.28);
}

TEST(Timing, ProcessorTimeOfTheLooksDoesNotCount) {
  // Each look at a problem of this size takes tens of microseconds, the solver itself nothing.
  constexpr int kCones = 20'000;
  problems::SparseMatrix W(3 * kCones, 3 * kCones);
  W.setIdentity();
  const problems::Problem large(
      problems::ReducedData{W, Eigen::VectorXd::Constant(3 * kCones, -1.0)},
      std::vector<problems::Cone>(kCones, problems::Cone::coulomb(3, 0.5)), {});
  const double before_s = seconds_of_processor();
  const TimedSolves timed = time_solves(looker(50), large, {}, {}, {});
  const double all_s = seconds_of_processor() - before_s;
  EXPECT_EQ(timed.curve.size(), 50u);
  EXPECT_LT(timed.cpu_s, 0.2 * all_s);
}

TEST(Timing, MemoryIsTheGrowthOfTheResidentPeak) {
  constexpr std::size_t kBytes = 64u << 20;
  const auto touch = [](std::size_t bytes) {
    void* const block =
        ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    for (std::size_t i = 0; i < bytes; i += 4096) static_cast<volatile char*>(block)[i] = 'x';
    ::munmap(block, bytes);
  };
  touch(2 * kBytes);  // an earlier peak, which is not the solver's
  solvers::Solver solver = honest_solver();
  solver.solve = [&](const problems::Problem&, const Request&) {
    touch(kBytes);
    return Result{};
  };
  const TimedSolves timed = time_one_contact(solver);
  EXPECT_NEAR(static_cast<double>(timed.memory_bytes), static_cast<double>(kBytes),
              4.0 * (1 << 20));
  EXPECT_GT(timed.process_peak_bytes, 2 * kBytes);
}

TEST(Timing, WhatASolverThrowsIsThrown) {
  solvers::Solver solver = honest_solver();
  int solves = 0;
  solver.solve = [&](const problems::Problem&, const Request&) -> Result {
    if (++solves > 2) throw std::logic_error("no more");
    Result result;
    result.solve_s = 0.25;
    return result;
  };
  EXPECT_THROW(time_one_contact(solver, {.by_confidence = true}), std::logic_error);
  Scripted scripted({0.25});
  EXPECT_EQ(time_one_contact(scripted.solver(), {.by_confidence = true}).solves, 6);
}

TEST(Timing, SettingsThatCannotBeMetAreErrors) {
  Scripted scripted({0.25});
  EXPECT_THROW(time_one_contact(scripted.solver(), {.spread_goal = 0.0}), problems::InputError);
  EXPECT_THROW(time_one_contact(scripted.solver(), {.most = 0}), problems::InputError);
  EXPECT_THROW(time_one_contact(scripted.solver(), {.budget_s = -1.0}), problems::InputError);
  EXPECT_EQ(scripted.solves(), 0);
}

}  // namespace
}  // namespace conebench::harness
