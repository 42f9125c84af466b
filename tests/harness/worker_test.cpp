#include "harness/worker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <thread>

#include "problems/error.h"
#include "solvers/registry.h"
#include "test_solvers.h"

namespace conebench::harness {
namespace {

using results::Record;
using results::Status;
using testing::HasSubstr;

Record run(const solvers::Solver& solver, std::uint64_t memory_bytes = 0) {
  const auto record = run_task(
      {.problems = {{.id = {.name = "one-contact"}, .load = [] { return only(one_contact()); }}},
       .solver = solver,
       .stop = {.tol = 1e-8, .time_limit_s = 1.0},
       .memory_limit_bytes = memory_bytes,
       .hard_limit_s = 5.0});
  EXPECT_TRUE(record.has_value());
  return *record;
}

TEST(Worker, AnHonestAnswerIsVerified) {
  const Record record = run(honest_solver());
  EXPECT_EQ(record.status, Status::kConverged);
  EXPECT_LE(record.eta, 1e-15);
  EXPECT_TRUE(record.solved());
  EXPECT_EQ(record.problem.content_sha256.size(), 64u);
  EXPECT_EQ(record.problem.cones, 1);
  EXPECT_GT(record.wall_s, 0.0);
  EXPECT_GT(record.peak_memory_bytes, 0u);
}

TEST(Worker, ALieIsRefuted) {
  const Record record = run(solver_that("liar", [](auto&) {}));
  EXPECT_EQ(record.status, Status::kRefuted);
  EXPECT_EQ(record.claimed, "converged");
  EXPECT_NEAR(record.eta, 1.0, 1e-12);  // r = 0: all of the violation is left
}

TEST(Worker, AModelIsJudgedButNotRefuted) {
  solvers::Solver model = solver_that("model", [](auto&) {});
  model.kind = solvers::Kind::kModel;
  const Record record = run(model);
  EXPECT_EQ(record.status, Status::kConverged);
  EXPECT_FALSE(record.solved());
}

// A contact that slides: what the associated law says of it is not what Coulomb's does.
Record run_sliding(const solvers::Solver& solver) {
  const auto load = [] {
    problems::SparseMatrix W(3, 3);
    W.setIdentity();
    return only({problems::ReducedData{W, Eigen::Vector3d(-1.0, 2.0, 0.0)},
                 {problems::Cone::coulomb(3, 0.5)},
                 {}});
  };
  const auto record = run_task(
      {.problems = {{.id = {}, .load = load}}, .solver = solver, .stop = {.time_limit_s = 1.0}});
  EXPECT_TRUE(record.has_value());
  return *record;
}

TEST(Worker, AModelOfOursIsJudgedTwice) {
  const Record gap = run_sliding(solvers::make_solver("ccp"));
  EXPECT_EQ(gap.kind, "model");
  EXPECT_EQ(gap.status, Status::kConverged);
  EXPECT_LE(gap.model_eta, 1e-8);
  EXPECT_GT(gap.eta, 0.1);
  EXPECT_FALSE(gap.solved());
  EXPECT_TRUE(run(solvers::make_solver("pyramid")).solved()) << "sticking inside the pyramid";
  EXPECT_EQ(run(honest_solver()).model_eta, Record::kUnknown);
}

TEST(Worker, AModelThatDoesNotSolveItsOwnProblemIsRefuted) {
  solvers::Solver liar = solver_that("ccp", [](auto&) {});
  liar.kind = solvers::Kind::kModel;
  const Record record = run_sliding(liar);
  EXPECT_EQ(record.status, Status::kRefuted);
  // At r = 0 the projections of -q = (1, -2) and of -q_hat = (0, -2) on the cone: 1.6 over 0.8.
  EXPECT_NEAR(record.model_eta, 2.0, 1e-12);
}

TEST(Worker, NanIsNotFinite) {
  const Record record =
      run(solver_that("nan", [](auto& r) { r(1) = std::numeric_limits<double>::quiet_NaN(); }));
  EXPECT_EQ(record.status, Status::kNotFinite);
  EXPECT_FALSE(record.solved());
}

TEST(Worker, TheWrongLengthIsBadOutput) {
  const Record record = run(solver_that("short", [](auto& r) { r.resize(2); }));
  EXPECT_EQ(record.status, Status::kBadOutput);
  EXPECT_THAT(record.error, HasSubstr("2 entries"));
}

TEST(Worker, AnAbortIsACrashThatNamesItsSignal) {
  const Record record = run(solver_that("abort", [](auto&) {
    std::fputs("about to abort\n", stderr);
    std::abort();
  }));
  EXPECT_EQ(record.status, Status::kCrashed);
  EXPECT_THAT(record.error, HasSubstr("SIGABRT"));
  EXPECT_THAT(record.error, HasSubstr("about to abort"));
}

TEST(Worker, ASegmentationFaultIsACrash) {
  const Record record = run(solver_that("segv", [](auto&) { ::raise(SIGSEGV); }));
  EXPECT_EQ(record.status, Status::kCrashed);
  EXPECT_THAT(record.error, HasSubstr("SIGSEGV"));
}

TEST(Worker, ExitAndExceptionsAreCrashes) {
  EXPECT_EQ(run(solver_that("exit", [](auto&) { ::_exit(0); })).status, Status::kCrashed);
  const Record thrown =
      run(solver_that("throw", [](auto&) { throw std::logic_error("never mind"); }));
  EXPECT_EQ(thrown.status, Status::kCrashed);
  EXPECT_THAT(thrown.error, HasSubstr("never mind"));
}

TEST(Worker, WhatASolverPrintsDoesNotReachTheRecord) {
  const Record record = run(solver_that("chatty", [](auto& r) {
    for (int i = 0; i < 100'000; ++i) {
      std::printf("{\"status\": \"nonsense\"}\n");
      std::fprintf(stderr, "more nonsense\n");
    }
    r << 1.0, -0.25, 0.0;
  }));
  EXPECT_EQ(record.status, Status::kConverged);
}

TEST(Worker, AHangIsKilledWithEverythingThatItStarted) {
  const std::string pid_file =
      testing::TempDir() + "conebench-grandchild-" + std::to_string(::getpid());
  const auto hang = [pid_file](Eigen::VectorXd&) {
    if (::fork() == 0) {
      std::ofstream(pid_file) << ::getpid() << std::flush;
      for (;;) ::pause();
    }
    for (;;) static_cast<void>(::getppid());  // busy
  };
  const auto record =
      run_task({.problems = {{.id = {}, .load = [] { return only(one_contact()); }}},
                .solver = solver_that("hang", hang),
                .hard_limit_s = 0.5});
  ASSERT_TRUE(record.has_value());
  EXPECT_EQ(record->status, Status::kKilledTime);
  EXPECT_GE(record->wall_s, 0.5);
  EXPECT_LT(record->wall_s, 5.0);

  pid_t grandchild = 0;
  std::ifstream(pid_file) >> grandchild;
  ASSERT_GT(grandchild, 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  std::ifstream stat("/proc/" + std::to_string(grandchild) + "/stat");
  std::string pid, name, state = "gone";
  stat >> pid >> name >> state;
  EXPECT_TRUE(state == "gone" || state == "Z") << state;
  std::remove(pid_file.c_str());
}

// A unit mass between two walls that close in: H = (1; -1), w = (-1; -1).
problems::Problem closing_walls() {
  problems::SparseMatrix M(1, 1), H(2, 1);
  M.insert(0, 0) = 1.0;
  H.insert(0, 0) = 1.0;
  H.insert(1, 0) = -1.0;
  return {problems::PrimalData{M, H, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(2, -1.0)},
          {problems::Cone::coulomb(1, 0.0), problems::Cone::coulomb(1, 0.0)},
          {}};
}

// What becomes of a solver that offers y as the proof that there is no solution.
Record claim_infeasible(const Eigen::VectorXd& y, solvers::Kind kind = solvers::Kind::kMethod,
                        const std::function<problems::Problem()>& load = closing_walls) {
  solvers::Solver solver = honest_solver();
  solver.kind = kind;
  solver.solve = [y](const problems::Problem&, const solvers::Request&) {
    solvers::Result result;
    result.status = solvers::Status::kInfeasible;
    result.certificate = y;
    return result;
  };
  const auto record = run_task({.problems = {{.id = {}, .load = [load] { return only(load()); }}},
                                .solver = solver,
                                .stop = {.time_limit_s = 1.0}});
  EXPECT_TRUE(record.has_value());
  EXPECT_EQ(record->claimed, "infeasible");
  EXPECT_FALSE(record->solved());
  return *record;
}

TEST(Worker, AProofThatThereIsNoSolutionIsAccepted) {
  const Record record = claim_infeasible(Eigen::Vector2d(1.0, 1.0));
  EXPECT_EQ(record.status, Status::kInfeasible);
  EXPECT_EQ(record.error, "");
}

TEST(Worker, AFalseProofThatThereIsNoSolutionIsRefuted) {
  for (const Eigen::Vector2d& y : {Eigen::Vector2d(1.0, 0.0), Eigen::Vector2d(-1.0, -1.0),
                                   Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(1.0, NAN)}) {
    const Record record = claim_infeasible(y);
    EXPECT_EQ(record.status, Status::kRefuted);
    EXPECT_THAT(record.error, HasSubstr("does not prove"));
  }
  const Record other = claim_infeasible(Eigen::Vector3d(1.0, 0.0, 0.0), solvers::Kind::kMethod,
                                        [] { return one_contact(); });
  EXPECT_EQ(other.status, Status::kRefuted) << "one contact has a solution";
}

TEST(Worker, AClaimThatThereIsNoSolutionWithoutAProofIsRefuted) {
  const Record record = claim_infeasible({});
  EXPECT_EQ(record.status, Status::kRefuted);
  EXPECT_THAT(record.error, HasSubstr("without a certificate"));
}

TEST(Worker, AModelMayHaveNoSolutionOfItsOwn) {
  EXPECT_EQ(claim_infeasible({}, solvers::Kind::kModel).status, Status::kInfeasible);
}

// Takes memory without end and uses it, so that the system cannot lend it for nothing.
void hoard(Eigen::VectorXd&) {
  std::vector<std::vector<double>> kept;
  for (;;) kept.emplace_back(1 << 20, 1.0);
}

TEST(Worker, AllocatingWithoutEndIsKilledMemory) {
  if (memory_limits_are_off()) GTEST_SKIP() << "address space is not limited under sanitizers";
  const Record record = run(solver_that("hoard", hoard), 512ULL << 20);
  EXPECT_EQ(record.status, Status::kKilledMemory);
  EXPECT_LT(record.peak_memory_bytes, 600ULL << 20);
}

TEST(Worker, ADeathByBadAllocIsKilledMemoryToo) {
  if (memory_limits_are_off()) GTEST_SKIP() << "address space is not limited under sanitizers";
  const auto hoard_noexcept = [](Eigen::VectorXd& r) noexcept { hoard(r); };
  EXPECT_EQ(run(solver_that("noexcept", hoard_noexcept), 512ULL << 20).status,
            Status::kKilledMemory);
}

TEST(Worker, ARefusalIsUnsupportedWithItsReason) {
  solvers::Solver solver = honest_solver();
  solver.refuses = [](const problems::Problem&) { return std::optional<std::string>("no cones"); };
  const Record record = run(solver);
  EXPECT_EQ(record.status, Status::kUnsupported);
  EXPECT_THAT(record.notes, testing::ElementsAre("no cones"));
}

TEST(Worker, AProblemThatCannotBeLoadedIsAnInputError) {
  const auto load = []() -> problems::ProblemFile {
    throw problems::InputError("file.h5", "is gone");
  };
  EXPECT_THROW(run_task({.problems = {{.id = {}, .load = load}},
                         .solver = honest_solver(),
                         .stop = {.time_limit_s = 1.0}}),
               problems::InputError);
}

TEST(Worker, TheHardLimitLeavesRoomToLoadAndToJudge) {
  EXPECT_DOUBLE_EQ(default_hard_limit_s(10.0), 50.0);
}

}  // namespace
}  // namespace conebench::harness
