// Solvers that do harm, as plugins (tests/harness/planted), in one campaign with honest ones.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>
#include <tuple>

#include "harness/campaign.h"
#include "harness/plugin_library.h"
#include "harness/small_problems.h"
#include "harness/variants.h"
#include "results/profiles.h"
#include "results/report.h"
#include "test_solvers.h"

namespace conebench::harness {
namespace {

namespace fs = std::filesystem;
using results::Record;
using results::Status;

constexpr double kHardLimit_s = 2.0, kGrace_s = 2.0;

// Which library, and how its tasks must end.
std::map<std::string, Status> planted() {
  std::map<std::string, Status> expected = {
      {"sleeper", Status::kKilledTime},
      {"forking_child", Status::kStalled},
      {"segfault", Status::kCrashed},
      {"abort", Status::kCrashed},
      {"nan", Status::kNotFinite},
      {"liar", Status::kRefuted},
      {"wrong_length", Status::kBadOutput},
      {"endless_stdout", Status::kKilledTime},
      {"ignores_sigterm", Status::kKilledTime},
      {"tight_only", Status::kRefuted},
      {"wrong_version", Status::kBadAbi},
      {"wrong_size", Status::kBadAbi},
      {"wrong_parameter_size", Status::kBadAbi},
      {"unknown_status", Status::kBadAbi},
      {"crashing_constructor", Status::kCrashed},
      {"hanging_constructor", Status::kKilledTime},
  };
  if (!memory_limits_are_off()) expected["memory_hog"] = Status::kKilledMemory;
  return expected;
}

// Processes other than this one that have a file of the folder mapped: every process that a library
// of the folder has run in, or that such a process has forked.
std::vector<std::string> processes_using(const fs::path& folder) {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string pid = entry.path().filename();
    if (pid.find_first_not_of("0123456789") != pid.npos || pid == std::to_string(::getpid())) {
      continue;
    }
    std::stringstream maps;
    maps << std::ifstream(entry.path() / "maps").rdbuf();
    if (maps.str().find(folder.string()) != std::string::npos) found.push_back(pid);
  }
  return found;
}

class PlantedTest : public testing::Test {
 protected:
  PlantedTest()
      : folder_(fs::path(testing::TempDir()) /
                ("conebench-planted-" + std::to_string(::getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "libraries");
  }
  ~PlantedTest() override { fs::remove_all(folder_); }

  // A copy that no other process of the machine has a reason to load.
  solvers::Solver plugin(const std::string& name) const {
    const fs::path copy = folder_ / "libraries" / (name + ".so");
    fs::copy_file(fs::path(CONEBENCH_PLANTED_DIR) / (name + ".so"), copy,
                  fs::copy_options::overwrite_existing);
    return make_solver("plugin:" + copy.string());
  }

  std::vector<Record> campaign(const std::string& name,
                               const std::vector<solvers::Solver>& solvers) const {
    Plan plan = small_plan(solvers);
    plan.hard_limit_s = kHardLimit_s;
    plan.memory_limit_bytes = 512ULL << 20;
    std::vector<ProblemSource> problems;
    for (const std::size_t i : {1u, 8u}) {
      const NamedRecipe named = small_recipes()[i];
      problems.push_back({.id = {.name = named.name, .content_sha256 = "sha-of-" + named.name},
                          .load = [named] { return only(make_named(named)); }});
    }
    const fs::path results = folder_ / name;
    run_campaign({.results_dir = results}, tasks_of(plan, problems));
    return results::read_journal(results::journal_path(results)).records;
  }

  fs::path folder_;
};

// What the presence of others must not change.
std::map<std::string, std::tuple<Status, double, std::int64_t>> outcomes(
    const std::vector<Record>& records, const std::vector<solvers::Solver>& of) {
  std::map<std::string, std::tuple<Status, double, std::int64_t>> found;
  for (const Record& record : records) {
    const auto same = [&](const solvers::Solver& s) { return s.name == record.solver; };
    if (std::none_of(of.begin(), of.end(), same)) continue;
    found[record.solver + " on " + record.problem.name] = {record.status, record.eta,
                                                           record.iterations};
  }
  return found;
}

void expect_unranked(const std::vector<Record>& records, const std::vector<std::string>& honest) {
  const std::vector<results::Group> groups = results::group_by_settings(records);
  ASSERT_EQ(groups.size(), 1u);
  for (const double tol : groups[0].tolerances()) {
    const auto ranking = results::rank(results::make_time_table(groups[0].methods, tol));
    for (std::size_t place = 0; place < ranking.size(); ++place) {
      const bool is_honest = std::ranges::count(honest, ranking[place].solver) > 0;
      EXPECT_EQ(place < honest.size(), is_honest) << ranking[place].solver << " at " << tol;
      EXPECT_EQ(ranking[place].solved, is_honest ? 2 : 0) << ranking[place].solver << " at " << tol;
      if (is_honest) continue;
      EXPECT_EQ(ranking[place].fastest, 0);
      EXPECT_EQ(ranking[place].area, 0.0);
      EXPECT_FALSE(ranking[place].common_mean_s.has_value());
    }
  }
}

TEST_F(PlantedTest, SolversThatDoHarmHarmOnlyTheirOwnRows) {
  const std::vector<solvers::Solver> honest = {make_solver("gs"), plugin("honest")};
  const std::vector<Record> alone = campaign("alone", honest);

  std::vector<solvers::Solver> all = honest;
  std::map<std::string, Status> expected;
  for (const auto& [name, status] : planted()) {
    all.push_back(plugin(name));
    expected[all.back().name] = status;
  }
  const std::vector<Record> together = campaign("together", all);

  EXPECT_EQ(together.size(), 2 * all.size());
  for (const Record& record : together) {
    EXPECT_LE(record.wall_s, kHardLimit_s + kGrace_s) << record.solver;
    if (!expected.contains(record.solver)) continue;
    EXPECT_EQ(record.status, expected[record.solver])
        << record.solver << ": " << to_string(record.status) << ", " << record.error;
    EXPECT_FALSE(record.solved()) << record.solver;
  }
  EXPECT_EQ(outcomes(alone, honest).size(), 4u);
  EXPECT_EQ(outcomes(together, honest), outcomes(alone, honest));
  expect_unranked(together, {honest[0].name, honest[1].name});
}

// A task must not be over before all of its processes are.
TEST_F(PlantedTest, NoProcessOutlivesItsTask) {
  for (const char* name : {"forking_child", "ignores_sigterm"}) {
    const std::vector<Record> records = campaign(name, {plugin(name)});
    EXPECT_EQ(records.size(), 2u);
    EXPECT_THAT(processes_using(folder_ / "libraries"), testing::IsEmpty()) << name;
  }
}

TEST_F(PlantedTest, TheSearchForSurvivorsFindsThem) {
  const solvers::Solver honest = plugin("honest");
  const pid_t child = ::fork();
  if (child == 0) {
    const PluginLibrary library(honest.program);
    for (;;) ::pause();
  }
  const auto found = [&] {
    return std::ranges::count(processes_using(folder_ / "libraries"), std::to_string(child)) == 1;
  };
  for (int i = 0; i < 1000 && !found(); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_TRUE(found());
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

}  // namespace
}  // namespace conebench::harness
