#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "harness/campaign.h"
#include "harness/command_line.h"
#include "harness/commands/commands.h"
#include "harness/demo_files.h"
#include "harness/diary.h"
#include "harness/interrupt.h"
#include "harness/report_views.h"
#include "harness/step_costs.h"
#include "harness/summary.h"
#include "harness/tasks.h"
#include "problems/error.h"
#include "results/journal.h"
#include "results/report.h"
#include "solvers/registry.h"

namespace conebench::harness {
namespace {

using Files = std::vector<std::filesystem::path>;

// What the demo compares: one of every kind of method, and Siconos where this build has it.
std::vector<std::string> demo_variants() {
  std::vector<std::string> variants = {"auto",        "apgd",      "gs",        "gs[omega=1.3]",
                                       "gs[skip=10]", "newton-ac", "newton-fb", "aclm",
                                       "ipm",         "spg"};
  for (const solvers::Method& method : solvers::all_methods()) {
    if (method.name == "siconos:nsgs" || method.name == "siconos:nsn-ac") {
      variants.push_back(method.name);
    }
  }
  return variants;
}

// The walls of the columns of spheres go at step 100: some steps of settling, most of collapse. The
// sand gets cells of twice the size, and a law that needs one solve a step.
std::vector<SceneExport> demo_scenes() {
  const std::string coarse = "grid.cells=[40,10]";
  return {{"column-dry", 300, 20, 20, {}},
          {"column-cohesive", 300, 20, 20, {}},
          {"sand-column", 100, 10, 10, {coarse}},
          {"sand-column-cohesive", 100, 10, 10, {coarse}}};
}
constexpr auto kSceneSolver = "auto";
constexpr double kSceneBudget_s = 25.0, kSceneLimit_s = 60.0;  // of wall time

constexpr double kTolerance = 1e-8, kTaskLimit_s = 0.5, kTaskHardLimit_s = 10.0;
constexpr std::uint64_t kTaskMemory = 2ULL << 30;

int demo_jobs() { return std::min(2, static_cast<int>(allowed_cores().size())); }

std::string joined(const Files& files) {
  std::string lines;
  for (const auto& file : files) lines += file.string() + "\n";
  return lines;
}

void append_lines(const std::string& lines, Files& files) {
  for (std::size_t start = 0, end; start < lines.size(); start = end + 1) {
    end = lines.find('\n', start);
    files.emplace_back(lines.substr(start, end - start));
  }
}

// Each scene in a process of its own, both at once where there are two cores. False: interrupted.
bool simulate_scenes(const std::vector<SceneExport>& scenes, const std::filesystem::path& folder,
                     const std::filesystem::path& summaries, Files& files) {
  const auto make = [&](std::size_t i) -> Job {
    return {.work =
                [scene = scenes[i], folder, summaries] {
                  return joined(export_scene(scene, kSceneBudget_s, kSceneSolver, folder,
                                             summaries / (scene.scene + ".json")));
                },
            .limits = {.wall_s = kSceneLimit_s, .memory_bytes = 0}};
  };
  const auto done = [&](std::size_t i, const ChildOutcome& outcome) {
    if (outcome.output.empty()) {
      throw problems::OutputError(scenes[i].scene, "no step exported: " + describe_end(outcome));
    }
    append_lines(outcome.output, files);
  };
  return run_pool(scenes.size(), demo_jobs(), {.make = make, .done = done, .tick = {}});
}

// A demo starts anew; the results of anything else are not touched.
void clear_results(const std::filesystem::path& results_dir) {
  const auto journal = results::journal_path(results_dir);
  if (!std::filesystem::exists(journal)) return;
  problems::require(campaign_command(results_dir).starts_with("conebench demo"),
                    results_dir.string(), "holds the results of another campaign");
  std::filesystem::remove(journal);
}

std::vector<Task> tasks_on(const std::vector<ProblemSource>& problems) {
  const auto solvers = make_all_solvers(demo_variants());
  const Plan plan{.stops = {{.tol = kTolerance, .time_limit_s = kTaskLimit_s}},
                  .solvers = {solvers.begin(), solvers.end()},
                  .modes = {Mode::kCold},
                  .donors = {},
                  .threads = {1},
                  .memory_limit_bytes = kTaskMemory,
                  .hard_limit_s = kTaskHardLimit_s};
  std::vector<Task> tasks = tasks_of_shard(make_task_groups(plan, problems).groups, {});
  shuffle(tasks, plan.seed);
  return tasks;
}

int demo(const std::filesystem::path& folder, const std::filesystem::path& data) {
  const auto problems_dir = folder / "problems", results_dir = folder / "results";
  clear_results(results_dir);
  const std::vector<SceneExport> scenes = demo_scenes();
  fmt::print(stderr, "1/4  simulating {} scenes: spheres (dem) and sand (mpm)\n", scenes.size());
  Files files;
  if (!simulate_scenes(scenes, problems_dir, simulations_folder(results_dir), files))
    return kInterruptedExit;
  fmt::print(stderr, "     {} steps exported to {}\n", files.size(), problems_dir.string());

  fmt::print(stderr, "2/4  making small problems with known solutions\n");
  const Files made = write_small_problems(problems_dir);
  files.insert(files.end(), made.begin(), made.end());
  if (!data.empty() && std::filesystem::is_directory(data)) files.push_back(data);
  const FoundSources found = find_sources(files, demo_jobs());
  if (found.interrupted) return kInterruptedExit;

  fmt::print(stderr, "3/4  solving to eta <= {:.0e}, {} solvers, on ", kTolerance,
             demo_variants().size());
  tell(found);
  const CampaignSummary summary = run_campaign({.results_dir = results_dir,
                                                .jobs = demo_jobs(),
                                                .command = command_line(),
                                                .show_progress = true},
                                               tasks_on(found.problems));
  const int code = tell(summary);
  if (summary.interrupted) return code;

  fmt::print(stderr, "4/4  report\n");
  const auto records = load_records(results_dir);
  const auto formats = results::report_formats();
  ReportViews views = make_views(records);
  const auto written =
      results::write_report({.records = records,
                             .command = command_line(),
                             .machine_marks = machine_marks(results_dir),
                             .scene_costs = read_scene_costs(results_dir),
                             .views = std::move(views.views),
                             .no_views = std::move(views.note)},
                            {.folder = folder, .formats = {formats.begin(), formats.end()}});
  print_rankings(records);
  for (const auto& file : written) fmt::print("{}\n", file.string());
  return code;
}

}  // namespace

void add_demo(CLI::App& app, int& exit_code) {
  struct Options {
    std::filesystem::path folder = "demo-results", data;
  };
  auto options = std::make_shared<Options>();
  CLI::App* verb = app.add_subcommand(
      "demo", "Simulate, export, solve with every kind of solver, report; less than 3 minutes");
  verb->add_option("-o,--output", options->folder, "Folder to write to")
      ->type_name("DIR")
      ->capture_default_str()
      ->take_last();
  verb->add_option("--data", options->data, "More problem files, used where the folder exists")
      ->type_name("DIR")
      ->take_last();
  verb->callback([options, &exit_code] { exit_code = demo(options->folder, options->data); });
}

}  // namespace conebench::harness
