#include "harness/campaign.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "problems/error.h"
#include "results/journal.h"
#include "test_solvers.h"

namespace conebench::harness {
namespace {

using results::Record;
using results::Status;

class CampaignTest : public testing::Test {
 protected:
  CampaignTest()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("conebench-campaign-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(folder_);
  }
  ~CampaignTest() override { std::filesystem::remove_all(folder_); }

  CampaignOptions options() const {
    return {.stop = {.tol = 1e-8, .time_limit_s = 1.0},
            .hard_limit_s = 1.0,
            .results_dir = folder_,
            .command = "a test"};
  }

  std::vector<Record> records() const {
    return results::read_journal(results::journal_path(folder_)).records;
  }

  int lines() const {
    std::ifstream file(results::journal_path(folder_));
    int count = 0;
    for (std::string line; std::getline(file, line);) ++count;
    return count;
  }

  std::filesystem::path folder_;
};

std::vector<ProblemSource> problems_numbered(int count) {
  std::vector<ProblemSource> sources;
  for (int i = 0; i < count; ++i) sources.push_back(source_named("p" + std::to_string(i)));
  return sources;
}

TEST_F(CampaignTest, ATaskThatDiesNeverTakesTheOthersWithIt) {
  const std::vector<solvers::Solver> solvers = {
      honest_solver(), solver_that("crash", [](auto&) { ::raise(SIGSEGV); }),
      solver_that("liar", [](auto&) {}), solver_that("hang", [](auto&) {
        for (;;) ::pause();
      })};
  const auto summary = run_campaign(options(), problems_numbered(2), solvers);
  EXPECT_EQ(summary.tasks, 8u);
  EXPECT_EQ(summary.done, 8u);
  std::map<std::string, std::set<Status>> statuses;
  for (const Record& record : records()) statuses[record.solver].insert(record.status);
  EXPECT_EQ(statuses["honest"], std::set{Status::kConverged});
  EXPECT_EQ(statuses["crash"], std::set{Status::kCrashed});
  EXPECT_EQ(statuses["liar"], std::set{Status::kRefuted});
  EXPECT_EQ(statuses["hang"], std::set{Status::kKilledTime});
  EXPECT_EQ(campaign_command(folder_), "a test");
}

TEST_F(CampaignTest, AFinishedCampaignHasNothingToDo) {
  const auto problems = problems_numbered(3);
  EXPECT_EQ(run_campaign(options(), problems, {honest_solver()}).done, 3u);
  const auto again = run_campaign(options(), problems, {honest_solver()});
  EXPECT_EQ(again.done, 0u);
  EXPECT_EQ(again.earlier, 3u);
  EXPECT_EQ(lines(), 3);
}

TEST_F(CampaignTest, ATornLineRunsItsTaskAgain) {
  const auto problems = problems_numbered(3);
  run_campaign(options(), problems, {honest_solver()});
  const auto path = results::journal_path(folder_);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 30);
  EXPECT_EQ(run_campaign(options(), problems, {honest_solver()}).done, 1u);
  EXPECT_EQ(records().size(), 3u);
}

TEST_F(CampaignTest, RerunsWhatItIsToldTo) {
  const auto problems = problems_numbered(2);
  const std::vector<solvers::Solver> solvers = {honest_solver(), solver_that("liar", [](auto&) {})};
  run_campaign(options(), problems, solvers);
  CampaignOptions again = options();
  again.rerun = Rerun::kFailed;
  EXPECT_EQ(run_campaign(again, problems, solvers).done, 2u);
  again.rerun = Rerun::kTimeouts;
  EXPECT_EQ(run_campaign(again, problems, solvers).done, 0u);
  again.rerun = Rerun::kAll;
  EXPECT_EQ(run_campaign(again, problems, solvers).done, 4u);
  EXPECT_THROW(rerun_from("some"), problems::InputError);
}

TEST_F(CampaignTest, RepetitionsAreTasksOfTheirOwn) {
  CampaignOptions twice = options();
  twice.repetitions = 2;
  EXPECT_EQ(run_campaign(twice, problems_numbered(2), {honest_solver()}).done, 4u);
  EXPECT_EQ(records().size(), 4u);
}

TEST_F(CampaignTest, TasksOfDifferentSolversInterleave) {
  const std::vector<solvers::Solver> solvers = {honest_solver(), solver_that("liar", [](auto&) {})};
  run_campaign(options(), problems_numbered(8), solvers);
  int changes = 0;
  const auto done = records();
  for (std::size_t i = 1; i < done.size(); ++i) changes += done[i].solver != done[i - 1].solver;
  EXPECT_GE(changes, 3);
}

TEST_F(CampaignTest, KilledInTheMiddleItGoesOnWithEachTaskExactlyOnce) {
  const auto problems = problems_numbered(20);
  const std::vector<solvers::Solver> slow = {solver_that(
      "slow", [](auto&) { std::this_thread::sleep_for(std::chrono::milliseconds(30)); })};
  const pid_t campaign = ::fork();
  if (campaign == 0) {
    run_campaign(options(), problems, slow);
    ::_exit(0);
  }
  while (lines() < 4) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ::kill(campaign, SIGKILL);
  ::waitpid(campaign, nullptr, 0);
  const int before = lines();
  ASSERT_LT(before, 20);

  const auto summary = run_campaign(options(), problems, slow);
  EXPECT_FALSE(summary.interrupted);
  std::multiset<std::string> names;
  for (const Record& record : records()) names.insert(record.problem.name);
  EXPECT_EQ(names.size(), 20u);
  for (const auto& problem : problems) EXPECT_EQ(names.count(problem.id.name), 1u);
  EXPECT_EQ(lines() - results::read_journal(results::journal_path(folder_)).torn_lines, 20);
}

TEST_F(CampaignTest, AFullDiskIsAnOutputErrorAndTheJournalStaysWhole) {
  const pid_t campaign = ::fork();
  if (campaign == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{4096, 4096};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      run_campaign(options(), problems_numbered(20), {honest_solver()});
    } catch (const problems::OutputError&) {
      ::_exit(3);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(campaign, &status, 0);
  EXPECT_EQ(WEXITSTATUS(status), 3);
  const auto content = results::read_journal(results::journal_path(folder_));
  EXPECT_GE(content.records.size(), 1u);
  EXPECT_EQ(content.torn_lines, 0);
  run_campaign(options(), problems_numbered(20), {honest_solver()});
  EXPECT_EQ(records().size(), 20u);
}

TEST_F(CampaignTest, MoreJobsThanCoresAreRefused) {
  CampaignOptions many = options();
  many.jobs = 100'000;
  EXPECT_THROW(run_campaign(many, problems_numbered(1), {honest_solver()}), problems::InputError);
}

}  // namespace
}  // namespace conebench::harness
