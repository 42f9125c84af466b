#include <nlohmann/json.hpp>

#include "harness/small_problems.h"
#include "problems/problem_file.h"
#include "results/page_files.h"
#include "tests/harness/program_test.h"

namespace conebench::harness {
namespace {

using testing::HasSubstr;

class CommandLineTest : public ProgramTest {
 protected:
  CommandLineTest() {
    std::filesystem::create_directories(problems());
    for (const std::size_t i : {1u, 5u}) {
      const NamedRecipe named = small_recipes()[i];
      problems::write_problem_file(problems() / (named.name + ".h5"),
                                   {make_named(named), {}, {}, {}});
    }
  }

  std::filesystem::path problems() const { return folder_ / "problems"; }
  std::string problem() const { return (problems() / "made-3d.h5").string(); }
};

TEST_F(CommandLineTest, HelpNamesEveryVerbAndTheExitCodes) {
  const Ran ran = conebench("--help");
  EXPECT_EQ(ran.code, 0);
  for (const char* verb : {"demo", "scene", "simulate", "export", "problem", "solver", "solve",
                           "run", "report", "doctor", "Exit codes"}) {
    EXPECT_THAT(ran.out, HasSubstr(verb));
  }
  EXPECT_EQ(conebench("--version").code, 0);
}

TEST_F(CommandLineTest, BadUseIsOneLineAndExitCodeTwo) {
  expect_usage_error("solv x", "did you mean 'solve'?");
  expect_usage_error("solver lis", "did you mean 'list'?");
  expect_usage_error("", "command");
  expect_usage_error("solve no-such-file.h5", "no-such-file.h5");
  expect_usage_error("solve " + problem() + " -s gsx", "gsx");
  expect_usage_error("solve " + problem() + " -s 'gs[omegaa=1]'", "omegaa");
  expect_usage_error("solve " + problem() + " --tolerance 1e-3", "--tolerance");
  expect_usage_error("solve " + problem() + " --tol -1", "tol");
  expect_usage_error("solve " + problem() + " --time-limit 3parsecs", "known units");
  expect_usage_error("run -p no-such-folder -s gs", "no-such-folder");
  expect_usage_error("report no-such-results", "no-such-results");
}

TEST_F(CommandLineTest, AFileThatIsNoProblemIsBadInput) {
  std::ofstream(folder_ / "text.h5") << "hello\n";
  expect_usage_error("solve text.h5", "text.h5");
}

TEST_F(CommandLineTest, SolvePrintsOneJsonObject) {
  const Ran ran = conebench("solve " + problem() + " -s gs --json --tol 1e-6 -o solution.h5");
  EXPECT_EQ(ran.code, 0) << ran.err;
  const auto json = nlohmann::json::parse(ran.out);
  for (const char* key :
       {"status", "solver", "eta", "fclib_residual", "iterations", "solve_s", "problem"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["status"], "converged");
  EXPECT_EQ(json["problem"], "made-3d");
  EXPECT_LE(json["eta"].get<double>(), 1e-6);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "solution.h5"));
}

TEST_F(CommandLineTest, SolveExitsOneUnlessTheVerifiedToleranceIsMet) {
  const Ran ran = conebench("solve " + problem() + " --tol 1e-300 --time-limit 10ms --json");
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_NE(nlohmann::json::parse(ran.out)["status"], "converged");
}

TEST_F(CommandLineTest, AnUnwritableSolutionIsExitCodeThree) {
  const Ran ran = conebench("solve " + problem() + " -o /proc/no-such-place/solution.h5");
  EXPECT_EQ(ran.code, 3);
  EXPECT_EQ(ran.error_lines(), 1) << ran.err;
}

TEST_F(CommandLineTest, RunsACampaignAndReportsIt) {
  const Ran ran = conebench("run -p problems -s gs spg --tol 1e-6 --time-limit 2s -o results");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("`gs`"));
  const Ran report = conebench("report results -o report");
  EXPECT_EQ(report.code, 0) << report.err;
  EXPECT_THAT(content(folder_ / "report" / "report.md"), HasSubstr("made-cohesive"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "report" / "profile.svg"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "report" / "results.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "report" / "report.tex"));
}

TEST_F(CommandLineTest, NamesTheReportsPage) {
  if (!results::page_files()) GTEST_SKIP() << "this build has no page";
  EXPECT_EQ(conebench("run -p problems -s gs --tol 1e-6 --time-limit 2s -o results").code, 0);
  const Ran report = conebench("report results -o there/page.html --format html");
  EXPECT_EQ(report.code, 0) << report.err;
  EXPECT_EQ(report.out, "there/page.html\n");
  const std::string page = content(folder_ / "there" / "page.html");
  EXPECT_THAT(page, HasSubstr("Nothing else was run"));
  EXPECT_THAT(page, HasSubstr("without a geometry"));
}

TEST_F(CommandLineTest, AFullDiskIsExitCodeThreeWithAMessage) {
  const Ran ran = conebench("run -p problems -s gs spg --time-limit 1s -o results", "ulimit -f 4;");
  EXPECT_EQ(ran.code, 3) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("journal.jsonl: File too large"));
}

TEST_F(CommandLineTest, SolversAreListedShownAndChecked) {
  EXPECT_THAT(conebench("solver list").out, HasSubstr("spg"));
  EXPECT_TRUE(nlohmann::json::parse(conebench("solver list --json").out).is_array());
  EXPECT_THAT(conebench("solver show gs").out, HasSubstr("omega"));
  expect_usage_error("solver show gx", "known: auto, ");
  const Ran check = conebench("solver check gs problems");
  EXPECT_EQ(check.code, 0) << check.out;
  EXPECT_THAT(check.out, HasSubstr("pass  made-3d"));
}

TEST_F(CommandLineTest, StatisticsProveWhetherThereIsASolution) {
  const problems::Problem infeasible =
      problems::make_backwards({.family = problems::Family::kInfeasible, .cones = 6, .seed = 3})
          .problem;
  problems::write_problem_file(problems() / "walls.h5", {infeasible, {}, {}, {}});
  const Ran ran = conebench("problem stats problems --certificate --json --time-limit 5s");
  EXPECT_EQ(ran.code, 0) << ran.err;
  const auto certificates = nlohmann::json::parse(ran.out)["certificates"];
  ASSERT_EQ(certificates.size(), 3u);
  for (const auto& found : certificates) {
    const bool walls = found["path"] == "problems/walls.h5";
    EXPECT_EQ(found["existence"], walls ? "none" : "exists") << found;
    EXPECT_THAT(found["existence_text"].get<std::string>(),
                HasSubstr(walls ? "no solution has velocities below" : "a solution exists"));
    EXPECT_EQ(found["rank"], walls ? 15 : 120) << found;
    EXPECT_EQ(found["null_space"], walls ? 3 : 0) << found;
    EXPECT_GT(found["condition"], 1.0) << found;
  }
  const std::string table = conebench("problem stats problems --certificate").out;
  for (const char* text :
       {"null space", "no solution has velocities below", "a solution exists", "rate_scale"}) {
    EXPECT_THAT(table, HasSubstr(text));
  }
}

TEST_F(CommandLineTest, StatisticsProveNothingUnasked) {
  EXPECT_FALSE(nlohmann::json::parse(conebench("problem stats problems --json").out)
                   .contains("certificates"));
  expect_usage_error("problem stats problems --certificate --time-limit 3parsecs", "known units");
  expect_usage_error("problem stats problems --time-limit 1s", "--certificate");
}

TEST_F(CommandLineTest, AProvenClaimOfNoSolutionIsAcceptedAndNotSolved) {
  const problems::Problem infeasible =
      problems::make_backwards({.family = problems::Family::kInfeasible, .cones = 6, .seed = 3})
          .problem;
  problems::write_problem_file(folder_ / "walls.h5", {infeasible, {}, {}, {}});
  const Ran ran = conebench("solve walls.h5 -s aclm --time-limit 5s --json --strict");
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_EQ(nlohmann::json::parse(ran.out)["status"], "infeasible") << ran.out;
}

TEST_F(CommandLineTest, TheDoctorSpeaksJson) {
  const auto json = nlohmann::json::parse(conebench("doctor --json").out);
  EXPECT_TRUE(json.contains("compiler"));
}

}  // namespace
}  // namespace conebench::harness
