// Shrinking failing problems: planted failures are found out exactly, whatever way they fail.

#include "harness/shrink.h"

#include <fstream>
#include <nlohmann/json.hpp>

#include "harness/failure.h"
#include "harness/variants.h"
#include "problems/error.h"
#include "problems/load.h"
#include "problems/made_backwards.h"
#include "problems/part.h"
#include "tests/harness/program_test.h"
#include "tests/harness/test_solvers.h"

namespace conebench::harness {
namespace {

using problems::Problem;
using problems::ProblemFile;
using results::Record;
using results::Status;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kCones = 24, kFirst = 5, kSecond = 17;  // of which planted/pair.c fails on two

// Cones 5 and 17 have the friction that planted/pair.c looks for.
Problem with_the_pair(const Problem& made) {
  std::vector<problems::Cone> cones(made.cones().begin(), made.cones().end());
  cones[kFirst] = problems::Cone::coulomb(cones[kFirst].dim, 0.125);
  cones[kSecond] = problems::Cone::coulomb(cones[kSecond].dim, 0.375);
  if (made.is_primal()) return made.with_laws(std::move(cones), made.w());
  return {problems::ReducedData{made.W(), made.q()}, std::move(cones), made.metadata()};
}

ProblemFile pair_file(bool reduced = false) {
  const Problem problem = with_the_pair(
      problems::make_backwards({.cones = kCones, .dims = {3}, .reduced = reduced, .seed = 3})
          .problem);
  problems::Metadata metadata = problem.metadata();
  metadata.name = "pair";
  metadata.origin = "made for a test";
  ProblemFile file = only(problem.with_metadata(metadata));
  file.guess = Eigen::VectorXd::LinSpaced(problem.rows(), 0.0, 1.0);
  return file;
}

std::string planted(const std::string& how) {
  return "plugin:" CONEBENCH_PLANTED_DIR "/pair.so[how=" + how + "]";
}

class Shrink : public ProgramTest {
 protected:
  std::filesystem::path write(const ProblemFile& file) const {
    problems::write_problem_file(folder_ / "whole.h5", file);
    return folder_ / "whole.h5";
  }

  Shrunk shrink_with(const solvers::Solver& solver, const std::string& failing = "") const {
    return shrink({.input = folder_ / "whole.h5",
                   .output = folder_ / "part.h5",
                   .solver = solver,
                   .stop = {.tol = 1e-6, .time_limit_s = 5.0},
                   .failing = failing},
                  {});
  }
};

Record run_on(const Problem& problem, const solvers::Solver& solver) {
  return *run_task({.problems = {{.id = {}, .load = [problem] { return only(problem); }}},
                    .solver = solver,
                    .stop = {.tol = 1e-6, .time_limit_s = 5.0}});
}

TEST_F(Shrink, LeavesTheTwoConesThatFailTogetherHoweverTheyFail) {
  const std::map<std::string, std::string> ways = {{"stalled", "stalled"},
                                                   {"abort", "crashed"},
                                                   {"hang", "killed_time"},
                                                   {"nan", "not_finite"},
                                                   {"liar", "refuted"}};
  write(pair_file());
  for (const auto& [how, status] : ways) {
    const Ran ran = conebench("problem shrink whole.h5 -s '" + planted(how) +
                              "' --tol 1e-6 --hard-limit 500ms -o " + how + ".h5 --json");
    ASSERT_EQ(ran.code, 0) << how << ": " << ran.err;
    const auto found = nlohmann::json::parse(ran.out);
    EXPECT_EQ(found["cones"], nlohmann::json({kFirst, kSecond})) << how;
    EXPECT_EQ(found["status"], status);
    EXPECT_EQ(found["failure"], status);
    EXPECT_EQ(found["minimal"], true);
    const ProblemFile part = problems::load_problem(folder_ / (how + ".h5"));
    EXPECT_EQ(part.problem.cone_count(), 2);
    EXPECT_LT(part.problem.dofs(), pair_file().problem.dofs());
    EXPECT_EQ(part.guess.size(), 6);
  }
}

TEST_F(Shrink, TheFileSaysOfWhatItIsAPart) {
  for (const bool reduced : {false, true}) {
    const ProblemFile whole = pair_file(reduced);
    write(whole);
    const Ran ran =
        conebench("problem shrink whole.h5 -s '" + planted("liar") + "' --tol 1e-6 -o part.h5");
    ASSERT_EQ(ran.code, 0) << ran.err;
    EXPECT_THAT(ran.out, HasSubstr("left      2 cones: 5, 17"));
    const Problem part = problems::load_problem(folder_ / "part.h5").problem;
    EXPECT_EQ(part.is_primal(), !reduced);
    EXPECT_EQ(part.name(), "pair/2_of_24_cones");
    const std::string& origin = part.metadata().origin;
    EXPECT_THAT(origin, HasSubstr("2 of the 24 cones of pair"));
    EXPECT_THAT(origin, HasSubstr(problems::content_sha256(whole.problem)));
    EXPECT_THAT(origin, HasSubstr("): 5, 17; plugin:"));
    EXPECT_THAT(origin, HasSubstr("fails on them: refuted; the whole: made for a test"));
    EXPECT_EQ(part.metadata().engine, whole.problem.metadata().engine);
    EXPECT_EQ(part.rate_scale(), whole.problem.rate_scale());
  }
}

// With a solver and a failure that nobody planted.
TEST_F(Shrink, WithoutAnyOneConeOfTheResultItDoesNotFail) {
  const solvers::Solver gs = make_solver("gs");
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Problem whole =
        problems::make_backwards({.cones = 20, .dims = {2, 3}, .seed = seed}).problem;
    write(only(whole));
    const std::int64_t enough = run_on(whole, gs).iterations / 2;
    const Shrunk found = shrink_with(gs, "iterations > " + std::to_string(enough));
    ASSERT_TRUE(found.minimal && found.confirmed);
    EXPECT_LT(std::ssize(found.kept), whole.cone_count());
    EXPECT_GT(found.last.iterations, enough);
    for (std::size_t k = 0; found.kept.size() > 1 && k < found.kept.size(); ++k) {
      std::vector<int> fewer = found.kept;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
      EXPECT_LE(run_on(part_of(whole, fewer, {}), gs).iterations, enough) << "seed " << seed;
    }
  }
}

TEST_F(Shrink, IsTheSameEveryTime) {
  write(pair_file());
  const Shrunk once = shrink_with(make_solver("gs"), "iterations > 20");
  const std::string hash = content_sha256(problems::load_problem(folder_ / "part.h5").problem);
  const Shrunk twice = shrink_with(make_solver("gs"), "iterations > 20");
  EXPECT_EQ(once.kept, twice.kept);
  EXPECT_EQ(once.runs, twice.runs);
  EXPECT_EQ(content_sha256(problems::load_problem(folder_ / "part.h5").problem), hash);
}

// Walls that close in: the search ends with contacts that contradict each other, and a proof.
TEST_F(Shrink, LeavesThePairThatHasNoSolution) {
  const Problem whole =
      problems::make_backwards(
          {.family = problems::Family::kInfeasible, .cones = 12, .dims = {3}, .seed = 2})
          .problem;
  write(only(whole));
  const Shrunk found = shrink_with(make_solver("aclm"), "infeasible");
  ASSERT_TRUE(found.minimal && found.confirmed);
  EXPECT_EQ(found.kept.size(), 2u);
}

// On its third run it is well again: the whole and one part have failed by then.
TEST_F(Shrink, SaysSoWhenTheFailureDoesNotComeAgain) {
  write(only(problems::make_backwards({.cones = 2, .dims = {3}, .seed = 3}).problem));
  const solvers::Solver moody = solver_that("moody", [&](Eigen::VectorXd& r) {
    const std::filesystem::path log = folder_ / "runs.txt";
    std::ofstream(log, std::ios::app) << "run\n";
    if (std::filesystem::file_size(log) <= 8) r(0) = std::numeric_limits<double>::quiet_NaN();
  });
  const Shrunk found = shrink_with(moody);
  EXPECT_TRUE(found.minimal);
  EXPECT_FALSE(found.confirmed);
  EXPECT_EQ(found.runs, 3u);
}

TEST_F(Shrink, InterruptedItLeavesTheSmallestPartSoFar) {
  write(pair_file());
  const std::string command = "cd '" + folder_.string() +
                              "' && timeout --preserve-status -s INT 3 " CONEBENCH_PROGRAM
                              " problem shrink whole.h5 -s '" +
                              planted("hang") + "' --hard-limit 500ms -o part.h5 > out.txt";
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_THAT(content(folder_ / "out.txt"), HasSubstr("interrupted"));
  const Problem part = problems::load_problem(folder_ / "part.h5").problem;
  EXPECT_GE(part.cone_count(), 2);
  EXPECT_THAT(part.name(), HasSubstr("_of_24_cones"));
}

TEST_F(Shrink, RefusesWhatDoesNotFailAndItsOwnInput) {
  const std::filesystem::path whole = write(pair_file());
  const std::string before = content(whole);
  const std::string verb = "problem shrink whole.h5 --tol 1e-6 ";
  expect_usage_error(verb + "-s newton-ac -o part.h5", "newton-ac: solves pair (converged");
  expect_usage_error(verb + "-s newton-ac --failing stalled -o part.h5", "expected: stalled");
  expect_usage_error(verb + "-s newton-ac --failing staled -o part.h5", "did you mean 'stalled'?");
  expect_usage_error(verb + "-s newton-ac --failing 'etta > 1' -o part.h5", "etta");
  expect_usage_error(verb + "-s newton-ac -o whole.h5", "whole.h5: is the problem itself");
  expect_usage_error(verb + "-s newton-ac --mode wram -o part.h5", "--mode");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "part.h5"));
  EXPECT_EQ(content(whole), before);
}

Record record_of(Status status, double eta) {
  Record record;
  record.status = status;
  record.eta = eta;
  record.settings.tol = 1e-6;
  return record;
}

TEST(Failure, IsTheStatusOfTheFirstRunUnlessSomethingElseIsSaid) {
  const Record stalled = record_of(Status::kStalled, 1e-3);
  const Failure as_before("", stalled);
  EXPECT_TRUE(as_before.seen_in(record_of(Status::kStalled, 1e-5)));
  EXPECT_FALSE(as_before.seen_in(record_of(Status::kStalled, 1e-7)));
  EXPECT_FALSE(as_before.seen_in(record_of(Status::kCrashed, Record::kUnknown)));
  const Failure by_eta("eta > 1e-4", stalled);
  EXPECT_FALSE(by_eta.seen_in(record_of(Status::kStalled, 1e-5)));
  EXPECT_TRUE(by_eta.seen_in(record_of(Status::kCrashed, Record::kUnknown)));
  EXPECT_TRUE(Failure("status == \"stalled\" && !solved", stalled).seen_in(stalled));
  EXPECT_THROW(Failure("", record_of(Status::kConverged, 1e-7)), problems::InputError);
  EXPECT_THROW(Failure("crashed", stalled), problems::InputError);
  EXPECT_THROW(Failure("eta > 1", stalled), problems::InputError);
}

TEST(Ranges, AreShort) {
  EXPECT_EQ(ranges_text({}), "");
  EXPECT_EQ(ranges_text({0, 3, 4, 5, 9, 10}), "0, 3-5, 9, 10");
}

}  // namespace
}  // namespace conebench::harness
