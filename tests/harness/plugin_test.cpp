#include "harness/plugin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "harness/small_problems.h"
#include "harness/solver_build.h"
#include "harness/variants.h"
#include "harness/worker.h"
#include "problems/error.h"
#include "problems/residual.h"
#include "test_solvers.h"

namespace conebench::harness {
namespace {

namespace fs = std::filesystem;
using results::Record;
using results::Status;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

std::string library(const std::string& name) {
  return std::string(CONEBENCH_PLANTED_DIR) + "/" + name + ".so";
}

std::string variant(const std::string& name) { return "plugin:" + library(name); }

Record run(const solvers::Solver& solver, const NamedRecipe& named,
           const solvers::Stop& stop = {.tol = 1e-8, .time_limit_s = 5.0}) {
  const auto record = run_task({.problems = {{.id = {.name = named.name},
                                              .load = [named] { return only(make_named(named)); }}},
                                .solver = solver,
                                .stop = stop});
  EXPECT_TRUE(record.has_value());
  return *record;
}

std::string error_of(const std::string& text) {
  try {
    make_solvers(text);
  } catch (const problems::InputError& error) {
    return error.what();
  }
  return "no error";
}

bool is_mapped_here(const std::string& path) {
  std::stringstream maps;
  maps << std::ifstream("/proc/self/maps").rdbuf();
  return maps.str().find(path) != std::string::npos;
}

TEST(Plugin, SolvesEveryKindOfSmallProblem) {
  for (const NamedRecipe& named : small_recipes()) {
    const Record record =
        run(make_solver(variant("honest")), named, {.tol = 1e-6, .time_limit_s = 30.0});
    EXPECT_EQ(record.status, Status::kConverged) << named.name << " " << record.error;
    EXPECT_LE(record.eta, 1e-6) << named.name;
    EXPECT_GT(record.iterations, 0) << named.name;
    EXPECT_GT(record.curve.size(), 1u) << named.name;
    EXPECT_EQ(record.kind, "peer");
  }
}

TEST(Plugin, TheSameMethodInCAndInCppTakesTheSameSweeps) {
  const NamedRecipe named = small_recipes()[1];
  const Record c = run(make_solver(variant("honest")), named);
  const Record cpp = run(make_solver(variant("honest_cpp")), named);
  EXPECT_EQ(cpp.status, Status::kConverged);
  EXPECT_NEAR(static_cast<double>(cpp.iterations), static_cast<double>(c.iterations), 2.0);
}

TEST(Plugin, ItsOwnTestDecidesWhenAskedTo) {
  const Record record = run(make_solver(variant("honest")), small_recipes()[1],
                            {.tol = 1e-6, .time_limit_s = 5.0, .test = solvers::StopTest::kOwn});
  EXPECT_EQ(record.status, Status::kConverged);
  EXPECT_EQ(record.claimed, "converged");
  EXPECT_LE(record.eta, 1e-6);
  EXPECT_TRUE(record.curve.empty());
}

TEST(Plugin, TheMonitorsLimitsHold) {
  const solvers::Solver solver = make_solver(variant("honest"));
  const Record few = run(solver, small_recipes()[1], {.tol = 1e-300, .max_iterations = 7});
  EXPECT_EQ(few.status, Status::kIterationLimit);
  EXPECT_EQ(few.iterations, 7);
  const Record brief = run(solver, small_recipes()[1], {.tol = 1e-300, .time_limit_s = 0.05});
  EXPECT_EQ(brief.status, Status::kTimeLimit);
}

TEST(Plugin, ItStartsFromTheGuess) {
  const problems::Problem standard = make_named(small_recipes()[1]).shifted();
  const solvers::Solver solver = make_solver(variant("honest"));
  const solvers::Stop stop{.tol = 1e-9};
  const solvers::Result cold = solver.solve(standard, {.stop = stop, .guess = {}});
  const solvers::Result warm = solver.solve(standard, {.stop = stop, .guess = cold.r});
  EXPECT_GT(cold.iterations, 0);
  EXPECT_EQ(warm.iterations, 0);
  EXPECT_EQ(warm.r, cold.r);
  EXPECT_LE(problems::evaluate_eta(standard, cold.r), 1e-9);
}

TEST(Plugin, ParametersAreCheckedOmittedAndGridded) {
  std::vector<std::string> names;
  for (const auto& solver : make_solvers(variant("honest") + "[omega=0.8,1.0]")) {
    names.push_back(solver.name);
  }
  EXPECT_THAT(names, ElementsAre(variant("honest") + "[omega=0.8]", variant("honest")));
  EXPECT_THAT(error_of(variant("honest") + "[omega=2.5]"), HasSubstr("expected 0.05 to 1.95"));
  EXPECT_THAT(error_of(variant("honest") + "[omga=1]"), HasSubstr("did you mean 'omega'?"));
  const NamedRecipe named = small_recipes()[1];
  const Record slow = run(make_solver(variant("honest") + "[omega=0.3]"), named);
  EXPECT_EQ(slow.status, Status::kConverged);
  EXPECT_GT(slow.iterations, run(make_solver(variant("honest")), named).iterations);
}

TEST(Plugin, EveryTypeOfParameterArrives) {
  const NamedRecipe named = small_recipes()[1];
  EXPECT_THAT(run(make_solver(variant("talker")), named).notes,
              Contains("flag 1, count 3, factor 0.5, label none"));
  const solvers::Solver other =
      make_solver(variant("talker") + "[label=a b,flag=false,count=12,factor=-1e3]");
  EXPECT_EQ(other.name, variant("talker") + "[count=12,factor=-1000,flag=false,label=a b]");
  EXPECT_THAT(run(other, named).notes, Contains("flag 0, count 12, factor -1000, label a b"));
  EXPECT_THAT(error_of(variant("talker") + "[answer=staled]"),
              HasSubstr("did you mean 'stalled'?"));
  EXPECT_THAT(error_of(variant("talker") + "[count=-1]"), HasSubstr("expected 0 to inf"));
  EXPECT_THAT(error_of(variant("talker") + "[count=1.5]"), HasSubstr("expected a number"));
  EXPECT_THAT(error_of(variant("talker") + "[flag=1]"), HasSubstr("expected true or false"));
}

TEST(Plugin, TheMatricesAreThoseOfTheProblem) {
  for (const NamedRecipe& named : small_recipes()) {
    const Record record = run(make_solver(variant("talker")), named);
    EXPECT_EQ(record.status, Status::kStalled) << record.error;
    const problems::Problem problem = make_named(named);
    EXPECT_THAT(
        record.notes,
        Contains(HasSubstr(named.name + ", N s, m/s: " + std::to_string(problem.cone_count()) +
                           " cones, " + std::to_string(problem.rows()) + " rows")));
    EXPECT_THAT(record.notes, Contains(StartsWith("consistent"))) << named.name;
  }
}

TEST(Plugin, ARefusalIsUnsupportedWithItsReason) {
  const Record record =
      run(make_solver(variant("talker") + "[answer=refusal]"), small_recipes()[1]);
  EXPECT_EQ(record.status, Status::kUnsupported);
  EXPECT_THAT(record.notes, ElementsAre("not today"));
}

TEST(Plugin, AProofThatThereIsNoSolutionIsCheckedLikeAnyOther) {
  const solvers::Solver solver = make_solver(variant("talker") + "[answer=infeasible]");
  EXPECT_EQ(run(solver, small_recipes()[4]).status, Status::kRefuted);
  // A unit mass between two walls that close in: y = (1, 1) is the proof.
  problems::SparseMatrix M(1, 1), H(2, 1);
  M.insert(0, 0) = 1.0;
  H.insert(0, 0) = 1.0;
  H.insert(1, 0) = -1.0;
  const problems::Problem walls(
      problems::PrimalData{M, H, Eigen::VectorXd::Zero(1), Eigen::VectorXd::Constant(2, -1.0)},
      {problems::Cone::coulomb(1, 0.0), problems::Cone::coulomb(1, 0.0)}, {});
  const auto record = run_task({.problems = {{.id = {}, .load = [walls] { return only(walls); }}},
                                .solver = solver,
                                .stop = {.time_limit_s = 1.0}});
  ASSERT_TRUE(record.has_value());
  EXPECT_EQ(record->status, Status::kInfeasible) << record->error;
}

TEST(Plugin, AFileThatIsNoPluginIsAnInputErrorThatNamesIt) {
  EXPECT_THAT(error_of("plugin:/no/such/library.so"), HasSubstr("/no/such/library.so: is no file"));
  EXPECT_THAT(error_of(variant("no_entry")), HasSubstr("no_entry.so: has no function"));
  const fs::path text = fs::path(testing::TempDir()) / ("text-" + std::to_string(::getpid()));
  std::ofstream(text) << "not a library\n";
  EXPECT_THAT(error_of("plugin:" + text.string()), HasSubstr(text.string()));
  fs::remove(text);
}

TEST(Plugin, MakingASolverRunsNoneOfItsCodeHere) {
  // honest_cpp: another test of this program loads honest.
  for (const char* name :
       {"honest_cpp", "crashing_constructor", "hanging_constructor", "wrong_version", "sleeper"}) {
    EXPECT_EQ(make_solver(variant(name)).name, variant(name));
    EXPECT_FALSE(is_mapped_here(library(name))) << name;
  }
}

TEST(Plugin, AnotherVersionOrSizeIsBadAbiBeforeAnythingElseIsRead) {
  for (const char* name : {"wrong_version", "wrong_size", "wrong_parameter_size"}) {
    const Record record = run(make_solver(variant(name)), small_recipes()[1]);
    EXPECT_EQ(record.status, Status::kBadAbi) << name << ": " << record.error;
    EXPECT_THAT(record.error, HasSubstr("expected"));
    EXPECT_THAT(record.error, HasSubstr(name));
  }
}

TEST(Plugin, ALieIsRefutedUnlessItHappensToBeTrue) {
  const solvers::Solver solver = make_solver(variant("tight_only"));
  const NamedRecipe named = small_recipes()[1];
  EXPECT_EQ(run(solver, named, {.tol = 1e-8, .time_limit_s = 5.0}).status, Status::kRefuted);
  EXPECT_EQ(run(solver, named, {.tol = 1e-11, .time_limit_s = 5.0}).status, Status::kConverged);
}

TEST(SolverBuild, IsTheFilesContentOrThisProgramsBuildId) {
  const std::string own = build_of(make_solver("gs"));
  EXPECT_EQ(own.size(), 40u);
  EXPECT_EQ(own.find_first_not_of("0123456789abcdef"), own.npos);
  EXPECT_EQ(build_of(make_solver("spg")), own);

  const fs::path copy = fs::path(testing::TempDir()) / ("copy-" + std::to_string(::getpid()));
  fs::copy_file(library("honest"), copy, fs::copy_options::overwrite_existing);
  const solvers::Solver solver = make_solver("plugin:" + copy.string());
  const std::string before = build_of(solver);
  EXPECT_EQ(before, build_of(make_solver(variant("honest") + "[omega=0.8]")));
  EXPECT_NE(before, own);
  std::ofstream(copy, std::ios::app) << "more";
  EXPECT_NE(build_of(solver), before);
  fs::remove(copy);
  EXPECT_THROW(build_of(solver), problems::InputError);
}

}  // namespace
}  // namespace conebench::harness
