#include "solvers/external.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "problems/error.h"
#include "problems/made_backwards.h"
#include "problems/residual.h"

namespace conebench::solvers {
namespace {

using problems::Problem;
using testing::ElementsAre;
using testing::HasSubstr;

namespace fs = std::filesystem;

bool python_has_h5py() {
  return std::system("/usr/bin/python3 -c 'import h5py, numpy' 2>/dev/null") == 0;
}

class External : public testing::Test {
 protected:
  External() {
    std::string name = (fs::temp_directory_path() / "external-test-XXXXXX").string();
    folder_ = ::mkdtemp(name.data());
  }
  ~External() override { fs::remove_all(folder_); }

  // The variant of a program with this text.
  std::string program(const std::string& text) {
    const fs::path path = folder_ / "program";
    std::ofstream(path) << text;
    fs::permissions(path, fs::perms::owner_all);
    return "exec:" + path.string();
  }
  std::string shell(const std::string& text) { return program("#!/bin/sh\n" + text + "\n"); }
  std::string python(const std::string& text) {
    return program("#!/usr/bin/python3\nimport sys, h5py, numpy as np\n" + text + "\n");
  }

  Result solve(const std::string& variant, const Stop& stop = {.tol = 1e-6}) {
    return make_solver(variant).solve(problem_, {stop, {}, nullptr});
  }

  fs::path folder_;
  Problem problem_ =
      problems::make_backwards({.cones = 8, .mu_high = 0.5, .cohesive_share = 0.5, .seed = 21})
          .problem.shifted();
};

TEST_F(External, ExampleSolvesBothForms) {
  if (!python_has_h5py()) GTEST_SKIP() << "/usr/bin/python3 has no numpy and h5py";
  const std::string variant =
      shell("exec /usr/bin/python3 " CONEBENCH_SOURCE_DIR "/examples/python/my_solver.py \"$@\"");
  for (const bool reduced : {false, true}) {
    problem_ = problems::make_backwards({.cones = 12,
                                         .dims = {3, 2, 6, 1},
                                         .mu_high = 0.5,
                                         .cohesive_share = 0.5,
                                         .reduced = reduced,
                                         .seed = 21})
                   .problem.shifted();
    const Result result = solve(variant);
    EXPECT_EQ(result.status, Status::kConverged);
    EXPECT_LE(problems::evaluate_eta(problem_, result.r), 1e-6);
    EXPECT_GT(result.iterations, 0);
    EXPECT_TRUE(result.notes.empty());
    const Result own = solve(variant, {.tol = 1e-6, .test = StopTest::kOwn});
    EXPECT_EQ(own.status, Status::kConverged);
  }
}

TEST_F(External, NameIsTheVariantAndTheProgramMustBeThere) {
  const std::string variant = shell("exit 0");
  EXPECT_EQ(make_solver("  " + variant + " ").name, variant);
  EXPECT_EQ(make_solver(variant).kind, Kind::kPeer);
  EXPECT_THROW(make_solver("exec:/no/such/program"), problems::InputError);
  std::ofstream(folder_ / "text") << "not to be executed";
  EXPECT_THROW(make_solver("exec:" + (folder_ / "text").string()), problems::InputError);
  EXPECT_THROW(make_solver("exec:"), problems::InputError);
}

TEST_F(External, GetsTheProtocolsArguments) {
  const fs::path seen = folder_ / "seen";
  solve(shell("echo \"$3 $4 $5 $#\" > " + seen.string() + "; test -s \"$1\" || exit 9; exit 1"),
        {.tol = 1e-5});
  std::string line;
  std::ifstream file(seen);
  std::getline(file, line);
  EXPECT_EQ(line, "--tol 1e-05 --time-limit 6");
}

TEST_F(External, ParametersBecomeOptionsAndListsMakeGrids) {
  const fs::path seen = folder_ / "seen";
  const std::string variant = shell("shift 6; echo \"$@\" >> " + seen.string() + "; exit 1");
  std::vector<std::string> names;
  for (const Solver& solver : make_solvers(" " + variant + "[sweeps=3, omega=0.8,1.3] ")) {
    names.push_back(solver.name);
    EXPECT_EQ("exec:" + solver.program.string(), variant);
    solver.solve(problem_, {{.tol = 1e-6}, {}, nullptr});
  }
  EXPECT_THAT(names,
              ElementsAre(variant + "[omega=0.8,sweeps=3]", variant + "[omega=1.3,sweeps=3]"));
  std::stringstream lines;
  lines << std::ifstream(seen).rdbuf();
  EXPECT_EQ(lines.str(), "--omega 0.8 --sweeps 3\n--omega 1.3 --sweeps 3\n");
  EXPECT_THROW(make_solver(variant + "[tol=1]"), problems::InputError);
  EXPECT_THROW(make_solver(variant + "[time-limit=1]"), problems::InputError);
  EXPECT_THROW(make_solver(variant + "[1]"), problems::InputError);
}

TEST_F(External, IterationsAreThoseOfTheSolutionFile) {
  if (!python_has_h5py()) GTEST_SKIP() << "/usr/bin/python3 has no numpy and h5py";
  const auto with_iterations = [&](const std::string& value) {
    return solve(
        python("n = h5py.File(sys.argv[1])['guess/r'].shape[0]\n"
               "file = h5py.File(sys.argv[2], 'w')\n"
               "file['solution/r'] = np.zeros(n)\n"
               "file['solution'].attrs['iterations'] = " +
               value));
  };
  const Result counted = with_iterations("17");
  EXPECT_EQ(counted.iterations, 17);
  EXPECT_EQ(counted.status, Status::kStalled);
  for (const char* wrong : {"-1", "'many'"}) {
    const Result refused = with_iterations(wrong);
    EXPECT_EQ(refused.status, Status::kDiverged);
    EXPECT_THAT(refused.notes, ElementsAre(HasSubstr("iterations")));
  }
}

TEST_F(External, LiarIsNotBelievedByTheCommonTest) {
  if (!python_has_h5py()) GTEST_SKIP() << "/usr/bin/python3 has no numpy and h5py";
  const std::string liar = python(
      "n = h5py.File(sys.argv[1])['guess/r'].shape[0]\n"
      "h5py.File(sys.argv[2], 'w')['solution/r'] = np.ones(n)");
  EXPECT_EQ(solve(liar).status, Status::kStalled);
  // With its own test its claim is reported as one, for the caller to verify.
  const Result own = solve(liar, {.tol = 1e-6, .test = StopTest::kOwn});
  EXPECT_EQ(own.status, Status::kConverged);
  EXPECT_GT(problems::evaluate_eta(problem_, own.r), 1e-6);
}

TEST_F(External, CrashIsAResult) {
  const Result result = solve(shell("kill -SEGV $$"));
  EXPECT_EQ(result.status, Status::kDiverged);
  EXPECT_THAT(result.notes, ElementsAre(HasSubstr("SIGSEGV")));
  EXPECT_EQ(result.r.size(), problem_.rows());
  EXPECT_THAT(solve(shell("exit 3")).notes, ElementsAre(HasSubstr("exit code 3, expected")));
  EXPECT_THAT(solve(program("no interpreter")).notes, ElementsAre(HasSubstr("127")));
}

TEST_F(External, WritingNothingOrRubbishIsAResult) {
  const Result nothing = solve(shell("exit 0"));
  EXPECT_EQ(nothing.status, Status::kDiverged);
  EXPECT_THAT(nothing.notes, ElementsAre(HasSubstr("without a solution file")));
  const Result rubbish = solve(shell("echo rubbish > \"$2\""));
  EXPECT_EQ(rubbish.status, Status::kDiverged);
  EXPECT_THAT(rubbish.notes, ElementsAre(HasSubstr("solution.h5")));
}

TEST_F(External, WrongLengthAndNaNAreResults) {
  if (!python_has_h5py()) GTEST_SKIP() << "/usr/bin/python3 has no numpy and h5py";
  const Result wrong = solve(python("h5py.File(sys.argv[2], 'w')['solution/r'] = np.zeros(3)"));
  EXPECT_EQ(wrong.status, Status::kDiverged);
  EXPECT_THAT(wrong.notes, ElementsAre(HasSubstr("/solution/r")));
  const Result nan =
      solve(python("n = h5py.File(sys.argv[1])['guess/r'].shape[0]\n"
                   "h5py.File(sys.argv[2], 'w')['solution/r'] = np.full(n, np.nan)"));
  EXPECT_EQ(nan.status, Status::kDiverged);
  EXPECT_EQ(nan.notes.size(), 1u);
}

TEST_F(External, HangIsKilledWithAllThatItStarted) {
  const auto start = std::chrono::steady_clock::now();
  const Result result = solve(shell("sleep 60 & sleep 60"), {.tol = 1e-6, .time_limit_s = 0.3});
  EXPECT_EQ(result.status, Status::kTimeLimit);
  EXPECT_THAT(result.notes, ElementsAre(HasSubstr("killed at the time limit")));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(10));
}

TEST_F(External, LeavesNoFolderBehind) {
  const fs::path seen = folder_ / "seen";
  solve(shell("dirname \"$1\" > " + seen.string()));
  std::string line;
  std::ifstream file(seen);
  std::getline(file, line);
  EXPECT_FALSE(line.empty());
  EXPECT_FALSE(fs::exists(line));
}

}  // namespace
}  // namespace conebench::solvers
