// Problem files of a run: those of a range as they come, those of a sample at its end.

#include "problems/engine/exporter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <numeric>
#include <thread>

#include "problems/error.h"
#include "problems/load.h"
#include "problems/made_backwards.h"
#include "problems/residual.h"
#include "tests/engine/own_folder.h"

namespace conebench::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

engine::SceneHeader scene_header() {
  engine::SceneHeader scene;
  scene.name = "made";
  scene.seed = 5;
  return scene;
}

// Stands for an engine: step s has a problem of its own, made from seed s, and none where s ends
// on 3. The iterations are s (s - 40)^2, hardest around a third of the way and at the end.
class MadeRun : public engine::Exporter {
 public:
  MadeRun(const fs::path& folder, const std::string& policy)
      : Exporter(folder, engine::parse_selection(policy), scene_header()) {}

  static bool has_problem(std::int64_t step) { return step % 10 != 3; }
  static std::int64_t iterations(std::int64_t step) { return step * (step - 40) * (step - 40); }

  static problems::MadeProblem problem(std::int64_t step) {
    problems::MadeProblem made = problems::make_backwards(
        {.cones = 20, .cohesive_share = 0.5, .seed = static_cast<std::uint64_t>(step)});
    made.problem =
        made.problem.with_metadata(engine::step_metadata(scene_header(), "made-up", step, 1e-3));
    return made;
  }

  void step(std::int64_t number) {
    engine::SolvedStep view{.step = number};
    if (!has_problem(number)) return write_if_selected(view, [] { return problems::Geometry{}; });
    const problems::MadeProblem made = problem(number);
    const problems::Problem standard = made.problem.shifted();
    const Eigen::VectorXd guess = Eigen::VectorXd::Constant(standard.rows(), 0.5);
    engine::StepAnswer answer;
    answer.r = made.solutions[0];
    answer.converged = true;
    answer.iterations = iterations(number);
    view.problem = &made.problem;
    view.standard = &standard;
    view.guess = &guess;
    view.answer = &answer;
    write_if_selected(view, [&] {
      ++geometries;
      problems::Geometry geometry;
      geometry.points.setConstant(made.problem.cone_count(), 3, static_cast<double>(number));
      return geometry;
    });
  }

  void steps(std::int64_t count) {
    for (std::int64_t s = 0; s < count; ++s) step(s);
  }

  int geometries = 0;
};

constexpr double kProblemsOf60 = 54.0;

class Exports : public OwnFolder {
 protected:
  // Reads all of a finished run back and compares each with what was to be written.
  void expect_whole(const MadeRun& run) const {
    EXPECT_EQ(count(), run.files().size()) << "something else is in the folder";
    EXPECT_TRUE(std::ranges::is_sorted(run.files()));
    for (const fs::path& path : run.files()) {
      const auto file = problems::read_problem_file(path);
      const problems::Metadata& metadata = file.problem.metadata();
      const problems::MadeProblem made = MadeRun::problem(metadata.step);
      EXPECT_EQ(path.filename().string(), metadata.name + ".h5");
      EXPECT_EQ(problems::content_sha256(file.problem), problems::content_sha256(made.problem));
      EXPECT_EQ(file.guess, Eigen::VectorXd::Constant(made.problem.rows(), 0.5));
      ASSERT_TRUE(file.solution && file.geometry);
      EXPECT_EQ(file.solution->r, made.solutions[0]);
      EXPECT_EQ(file.solution->eta,
                problems::evaluate_eta(made.problem.shifted(), made.solutions[0]));
      EXPECT_EQ(file.geometry->points(0, 0), static_cast<double>(metadata.step));
    }
  }

  static double weight(const fs::path& path) {
    return problems::read_problem_file(path).problem.metadata().sampling_weight;
  }

  static double total_weight(const std::vector<fs::path>& files) {
    return std::accumulate(files.begin(), files.end(), 0.0,
                           [](double sum, const fs::path& path) { return sum + weight(path); });
  }

  static std::string bytes(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path provisional() const { return folder_ / ".made.provisional"; }
};

TEST_F(Exports, OfARangeHoldItsStepsWithTheStrideAsWeight) {
  for (const auto& [policy, files, total] :
       {std::tuple("all", 54u, 54.0), std::tuple("every:10", 6u, 60.0),
        std::tuple("every:3", 18u, 54.0), std::tuple("10..19", 9u, 9.0)}) {
    fs::remove_all(folder_);
    MadeRun run(folder_, policy);
    run.steps(60);
    run.finish();
    EXPECT_EQ(run.files().size(), files) << policy;
    EXPECT_EQ(run.geometries, run.written());
    EXPECT_EQ(total_weight(run.files()), total) << policy;
    expect_whole(run);
  }
}

TEST_F(Exports, CountSelectedStepsWithoutAProblem) {
  for (const auto& [policy, without] : {std::pair("all", 6), std::pair("every:13", 1),
                                        std::pair("hardest:2", 6), std::pair("reservoir:2", 6)}) {
    MadeRun run(folder_, policy);
    run.steps(60);
    run.finish();
    EXPECT_EQ(run.without_problem(), without) << policy;
  }
}

TEST_F(Exports, OfSamplesStandForAllSteps) {
  for (const std::string policy : {"reservoir:7", "stratified:7", "reservoir:100"}) {
    fs::remove_all(folder_);
    MadeRun run(folder_, policy);
    run.steps(60);
    run.finish();
    EXPECT_EQ(run.written(), policy == "reservoir:100" ? 54 : 7);
    EXPECT_NEAR(total_weight(run.files()), kProblemsOf60, 1e-9) << policy;
    expect_whole(run);
  }
}

TEST_F(Exports, OfTheHardestStepsHoldThese) {
  MadeRun run(folder_, "hardest:3");
  run.steps(60);
  run.finish();
  // 59, 58 and 57 with 21299, 18792 and 16473 iterations.
  EXPECT_EQ(run.files().front(), folder_ / "made_000057.h5");
  EXPECT_EQ(run.files().back(), folder_ / "made_000059.h5");
  EXPECT_EQ(total_weight(run.files()), 3.0);
  expect_whole(run);
}

TEST_F(Exports, OfSamplesAreTheSameBytesEveryTimeAndAsIfTheWeightHadBeenKnown) {
  std::vector<std::string> first;
  for (int turn = 0; turn < 2; ++turn) {
    fs::remove_all(folder_);
    MadeRun run(folder_, "stratified:7");
    run.steps(60);
    run.finish();
    std::vector<std::string> files;
    for (const fs::path& path : run.files()) files.push_back(bytes(path));
    if (turn == 0) first = files;
    EXPECT_EQ(files, first);
    const fs::path again = folder_ / "again.h5";
    problems::write_problem_file(again, problems::read_problem_file(run.files()[3]));
    EXPECT_EQ(bytes(again), bytes(run.files()[3]));
  }
}

TEST_F(Exports, BuildTheGeometryOfKeptStepsOnly) {
  MadeRun run(folder_, "hardest:2");
  run.step(20);
  run.step(15);
  EXPECT_EQ(run.geometries, 2);
  for (const std::int64_t easy : {1, 2, 39, 40}) run.step(easy);
  EXPECT_EQ(run.geometries, 2);
}

TEST_F(Exports, OfSamplesAreUnseenUntilTheEnd) {
  MadeRun run(folder_, "reservoir:7");
  run.steps(60);
  EXPECT_EQ(count(), 1u);  // hidden
  EXPECT_TRUE(problems::find_problems({folder_}).files.empty());
  run.finish();
  EXPECT_EQ(problems::find_problems({folder_}).files.size(), 7u);
  EXPECT_FALSE(fs::exists(provisional()));
}

TEST_F(Exports, ThatNobodyFinishesAreFinishedInTheEnd) {
  for (const std::string policy : {"all", "reservoir:7"}) {
    fs::remove_all(folder_);
    MadeRun(folder_, policy).steps(60);
    EXPECT_EQ(count(), policy == "all" ? 54u : 7u);
    EXPECT_NEAR(total_weight(problems::find_problems({folder_}).files), kProblemsOf60, 1e-9);
  }
}

TEST_F(Exports, OfOneSceneToOneFolderAreRefusedASecondTime) {
  MadeRun run(folder_, "reservoir:7");
  try {
    MadeRun(folder_, "hardest:2");
    FAIL() << "not refused";
  } catch (const problems::InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("another run exports the same scene"));
  }
  run.steps(60);
  run.finish();
  expect_whole(run);
}

std::ptrdiff_t entries(const fs::path& folder) {
  std::error_code none;
  return std::distance(fs::directory_iterator(folder, none), fs::directory_iterator{});
}

// Runs in a process of its own that is killed once `seen` has so many files, hidden ones included.
void expect_nothing_half_written(const fs::path& folder, const std::string& policy,
                                 const fs::path& seen, std::ptrdiff_t files) {
  const pid_t child = ::fork();
  if (child == 0) {
    MadeRun run(folder, policy);
    for (std::int64_t step = 0;; ++step) run.step(step);
  }
  while (entries(seen) < files) std::this_thread::yield();
  ::kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
  const auto found = problems::find_problems({folder}).files;
  EXPECT_TRUE(found.empty() || policy == "all");
  for (const fs::path& path : found) EXPECT_NO_THROW(problems::read_problem_file(path)) << path;
}

TEST_F(Exports, ThatAreKilledLeaveWholeFilesOrNone) {
  for (const std::ptrdiff_t files : {1, 2, 5, 9}) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    expect_nothing_half_written(folder_, "all", folder_, files);
  }
}

TEST_F(Exports, ThatAreKilledLeaveAFolderThatTheNextOneClears) {
  fs::create_directories(folder_);
  // Replaced ever more seldom, so that the files catch up; the first is the lock.
  for (const std::ptrdiff_t files : {1, 3, 8}) {
    expect_nothing_half_written(folder_, "reservoir:9", provisional(), files);
    EXPECT_GE(entries(provisional()), files);
  }
  MadeRun run(folder_, "reservoir:7");
  EXPECT_EQ(entries(provisional()), 1);
  run.steps(60);
  run.finish();
  expect_whole(run);
}

// A limit on the size of files stands for a full disk.
class FullDisk {
 public:
  FullDisk() : before_(std::signal(SIGXFSZ, SIG_IGN)) { set(2048); }
  ~FullDisk() {
    set(RLIM_INFINITY);
    std::signal(SIGXFSZ, before_);
  }

 private:
  static void set(rlim_t bytes) {
    rlimit limit{};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = std::min(bytes, limit.rlim_max);
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }

  sighandler_t before_;
};

TEST_F(Exports, ToAFullDiskFailAtALaterStepAndLeaveNothing) {
  for (const std::string policy : {"all", "reservoir:7"}) {
    MadeRun run(folder_, policy);
    const FullDisk full;
    EXPECT_THROW(for (std::int64_t step = 0; step < 100'000; ++step) run.step(step),
                 problems::OutputError);
    EXPECT_THROW(run.finish(), problems::OutputError);
  }
  EXPECT_EQ(count(), 0u);
}

TEST_F(Exports, ToAFullDiskFailAtTheEndAtLast) {
  for (const std::string policy : {"all", "reservoir:7"}) {
    MadeRun run(folder_, policy);
    const FullDisk full;
    run.step(1);
    EXPECT_THROW(run.finish(), problems::OutputError);
  }
  EXPECT_EQ(count(), 0u);
}

TEST_F(Exports, ToAPlaceThatIsNoFolderFailAtOnce) {
  std::ofstream(folder_) << "a file, not a folder";
  EXPECT_THROW(MadeRun(folder_ / "in", "all"), problems::OutputError);
}

TEST_F(Exports, TellWhatTheyCostTheEngine) {
  MadeRun run(folder_, "all");
  EXPECT_EQ(run.cost().total_s, 0.0);
  run.steps(60);
  run.finish();
  const engine::ExportCost cost = run.cost();
  EXPECT_GT(cost.total_s, 0.0);
  EXPECT_LE(cost.waited_s, cost.total_s);
}

}  // namespace
}  // namespace conebench::test
