#include "harness/campaign.h"
#include "harness/diary.h"

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

  CampaignOptions options() const { return {.results_dir = folder_, .command = "a test"}; }

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

CampaignSummary run(const CampaignOptions& options, const std::vector<ProblemSource>& problems,
                    const std::vector<solvers::Solver>& solvers) {
  return run_campaign(options, tasks_of(small_plan(solvers), problems));
}

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
  const auto summary = run(options(), problems_numbered(2), solvers);
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
  EXPECT_EQ(run(options(), problems, {honest_solver()}).done, 3u);
  const auto again = run(options(), problems, {honest_solver()});
  EXPECT_EQ(again.done, 0u);
  EXPECT_EQ(again.earlier, 3u);
  EXPECT_EQ(lines(), 3);
}

TEST_F(CampaignTest, ATornLineRunsItsTaskAgain) {
  const auto problems = problems_numbered(3);
  run(options(), problems, {honest_solver()});
  const auto path = results::journal_path(folder_);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 30);
  EXPECT_EQ(run(options(), problems, {honest_solver()}).done, 1u);
  EXPECT_EQ(records().size(), 3u);
}

TEST_F(CampaignTest, RerunsWhatItIsToldTo) {
  const auto problems = problems_numbered(2);
  const std::vector<solvers::Solver> solvers = {honest_solver(), solver_that("liar", [](auto&) {})};
  run(options(), problems, solvers);
  CampaignOptions again = options();
  again.rerun = Rerun::kFailed;
  EXPECT_EQ(run(again, problems, solvers).done, 2u);
  again.rerun = Rerun::kTimeouts;
  EXPECT_EQ(run(again, problems, solvers).done, 0u);
  again.rerun = Rerun::kAll;
  EXPECT_EQ(run(again, problems, solvers).done, 4u);
  EXPECT_THROW(rerun_from("some"), problems::InputError);
}

TEST_F(CampaignTest, AModelThatSolvesItsModelAndAProofAreNoFailures) {
  const auto problems = problems_numbered(1);
  solvers::Solver model = solver_that("model", [](auto&) {});  // far from the problem's solution
  model.kind = solvers::Kind::kModel;
  run(options(), problems, {model});
  CampaignOptions again = options();
  again.rerun = Rerun::kFailed;
  EXPECT_EQ(run(again, problems, {model}).done, 0u);
  auto proof = records();
  ASSERT_EQ(proof.size(), 1u);
  proof[0].kind = "method";
  const auto tasks = tasks_of(small_plan({model}), problems);
  EXPECT_EQ(open_tasks(tasks, proof, Rerun::kFailed).size(), 1u);
  proof[0].status = Status::kInfeasible;
  EXPECT_EQ(open_tasks(tasks, proof, Rerun::kFailed).size(), 0u);
}

TEST_F(CampaignTest, RepetitionsAreTasksOfTheirOwn) {
  Plan twice = small_plan({honest_solver()});
  twice.repetitions = 2;
  EXPECT_EQ(run_campaign(options(), tasks_of(twice, problems_numbered(2))).done, 4u);
  EXPECT_EQ(records().size(), 4u);
}

TEST_F(CampaignTest, TasksOfDifferentSolversInterleave) {
  const std::vector<solvers::Solver> solvers = {honest_solver(), solver_that("liar", [](auto&) {})};
  run(options(), problems_numbered(8), solvers);
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
    run(options(), problems, slow);
    ::_exit(0);
  }
  while (lines() < 4) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  ::kill(campaign, SIGKILL);
  ::waitpid(campaign, nullptr, 0);
  const int before = lines();
  ASSERT_LT(before, 20);

  const auto summary = run(options(), problems, slow);
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
      run(options(), problems_numbered(20), {honest_solver()});
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
  run(options(), problems_numbered(20), {honest_solver()});
  EXPECT_EQ(records().size(), 20u);
}

TEST_F(CampaignTest, ShardsShareTheWorkAndKnowOfEachOther) {
  const auto problems = problems_numbered(7);
  const std::vector<solvers::Solver> solvers = {honest_solver(), solver_that("liar", [](auto&) {})};
  const auto groups = make_task_groups(small_plan(solvers), problems).groups;
  CampaignOptions shard = options();
  std::size_t done = 0;
  for (int i = 1; i <= 3; ++i) {
    shard.shard = {.index = i, .count = 3};
    const auto tasks = tasks_of_shard(groups, shard.shard);
    EXPECT_GE(tasks.size(), 4u);
    done += run_campaign(shard, tasks).done;
  }
  EXPECT_EQ(done, 14u);
  EXPECT_EQ(results::read_results(folder_).records.size(), 14u);
  EXPECT_EQ(run(options(), problems, solvers).done, 0u);  // cut otherwise, nothing is left to do
}

std::vector<ProblemSource> steps_of_a_scene(int count) {
  std::vector<ProblemSource> steps = problems_numbered(count);
  for (int i = 0; i < count; ++i) {
    steps[static_cast<std::size_t>(i)].id.family = "dem/scene";
    steps[static_cast<std::size_t>(i)].step = i;
  }
  return steps;
}

TEST_F(CampaignTest, ASequenceStartsEachStepFromTheAnswerBefore) {
  const solvers::Solver zero = solver_that("zero", [](auto&) {});
  Plan plan = small_plan({honest_solver()});
  plan.modes = {Mode::kSequence};
  plan.donors = {std::nullopt, zero};
  const auto summary = run_campaign(options(), tasks_of(plan, steps_of_a_scene(3)));
  EXPECT_EQ(summary.done, 2u);
  std::map<std::string, std::vector<double>> guesses;
  for (const Record& record : records()) {
    EXPECT_EQ(record.sequence.length, 3);
    EXPECT_EQ(record.sequence.name, "dem/scene, steps 0 to 2");
    EXPECT_EQ(record.settings.mode, "sequence");
    EXPECT_TRUE(record.solved());
    guesses[record.donor].push_back(record.guess_eta);
  }
  ASSERT_EQ(guesses[""].size(), 3u);
  ASSERT_EQ(guesses["zero"].size(), 3u);
  EXPECT_NEAR(guesses[""][0], 1.0, 1e-12);  // r = 0 at the first step
  EXPECT_LE(guesses[""][1], 1e-15);
  EXPECT_LE(guesses[""][2], 1e-15);
  for (const double eta : guesses["zero"]) EXPECT_NEAR(eta, 1.0, 1e-12);
}

TEST_F(CampaignTest, ATornSequenceIsRunAgainAsAWhole) {
  Plan plan = small_plan({honest_solver()});
  plan.modes = {Mode::kSequence};
  const auto tasks = tasks_of(plan, steps_of_a_scene(4));
  ASSERT_EQ(run_campaign(options(), tasks).done, 1u);
  const auto path = results::journal_path(folder_);
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 30);
  EXPECT_EQ(records().size(), 0u);
  EXPECT_EQ(run_campaign(options(), tasks).done, 1u);
  EXPECT_EQ(records().size(), 4u);
  EXPECT_EQ(run_campaign(options(), tasks).done, 0u);
}

TEST_F(CampaignTest, AWorkerThatDiesInASequenceLeavesARowForEachStep) {
  Plan plan = small_plan({solver_that("crash", [](auto&) { ::raise(SIGSEGV); })});
  plan.modes = {Mode::kSequence};
  run_campaign(options(), tasks_of(plan, steps_of_a_scene(3)));
  const auto rows = records();
  ASSERT_EQ(rows.size(), 3u);
  for (const Record& row : rows) EXPECT_EQ(row.status, Status::kCrashed);
}

TEST_F(CampaignTest, TheGuessInTheFileIsWhereWarmStartsFrom) {
  auto problems = problems_numbered(2);
  problems[0].has_guess = true;
  problems[0].load = [] {
    problems::ProblemFile file = only(one_contact());
    file.guess.resize(3);
    file.guess << 1.0, -0.25, 0.0;
    return file;
  };
  Plan plan = small_plan({honest_solver()});
  plan.modes = {Mode::kCold, Mode::kWarm};
  EXPECT_EQ(run_campaign(options(), tasks_of(plan, problems)).done, 3u);
  for (const Record& record : records()) {
    EXPECT_NEAR(record.guess_eta, record.settings.mode == "warm" ? 0.0 : 1.0, 1e-12);
  }
}

TEST_F(CampaignTest, WhatItRanOnIsWrittenDown) {
  run(options(), problems_numbered(1), {honest_solver()});
  std::ifstream file(folder_ / "campaign.json");
  const auto about = nlohmann::json::parse(file);
  for (const char* when : {"calibration_before", "calibration_after"}) {
    EXPECT_GT(about.at(when).at("arithmetic_s").get<double>(), 0.0) << when;
    EXPECT_GT(about.at(when).at("memory_s").get<double>(), 0.0) << when;
  }
  EXPECT_TRUE(about.at("drift").is_array());
  EXPECT_FALSE(about.at("host").at("cpu").get<std::string>().empty());
}

TEST_F(CampaignTest, AnotherBuildOrToleranceOrModeIsAnotherTask) {
  const auto problems = problems_numbered(2);
  run(options(), problems, {honest_solver()});
  Plan plan = small_plan({honest_solver()});
  plan.stops.front().tol = 1e-6;
  EXPECT_EQ(run_campaign(options(), tasks_of(plan, problems)).done, 2u);
  plan.modes = {Mode::kWarm};
  EXPECT_EQ(tasks_of(plan, problems).size(), 0u);  // no guess in the file
  auto records = results::read_results(folder_).records;
  ASSERT_EQ(records.size(), 4u);
  for (Record& record : records) record.solver_build = "another";
  EXPECT_EQ(open_tasks(tasks_of(plan, problems), records, Rerun::kNone).size(), 0u);
  plan.modes = {Mode::kCold};
  EXPECT_EQ(open_tasks(tasks_of(plan, problems), records, Rerun::kNone).size(), 2u);
}

TEST_F(CampaignTest, TimesOfOneSolveAndOfManyAreDifferentTasks) {
  const auto problems = problems_numbered(2);
  run(options(), problems, {honest_solver()});
  Plan often = small_plan({honest_solver()});
  often.repeat_for_confidence = true;
  EXPECT_EQ(run_campaign(options(), tasks_of(often, problems)).done, 2u);
  EXPECT_EQ(run_campaign(options(), tasks_of(often, problems)).done, 0u);
  EXPECT_EQ(run(options(), problems, {honest_solver()}).done, 0u);
}

TEST_F(CampaignTest, MoreJobsThanCoresAreRefused) {
  CampaignOptions many = options();
  many.jobs = 100'000;
  EXPECT_THROW(run(many, problems_numbered(1), {honest_solver()}), problems::InputError);
}

}  // namespace
}  // namespace conebench::harness
