#include <fmt/format.h>

#include <memory>

#include "harness/campaign.h"
#include "harness/command_line.h"
#include "harness/commands/commands.h"
#include "harness/interrupt.h"
#include "harness/settings.h"
#include "harness/summary.h"
#include "problems/error.h"
#include "results/journal.h"

namespace conebench::harness {
namespace {

struct RunOptions {
  std::vector<std::filesystem::path> paths;
  std::vector<std::string> solvers;
  SolveSettings settings;
  int repetitions = 1, jobs = 1;
  std::uint64_t seed = 1;
  std::string rerun = "none";
  std::filesystem::path results_dir = "results";
};

int run(const RunOptions& options) {
  const auto solvers = make_all_solvers(options.solvers);
  CampaignOptions campaign{.stop = options.settings.checked_stop(),
                           .memory_limit_bytes = options.settings.memory_limit_bytes(),
                           .hard_limit_s = options.settings.hard_limit_s(),
                           .repetitions = options.repetitions,
                           .seed = options.seed,
                           .jobs = options.jobs,
                           .rerun = rerun_from(options.rerun),
                           .results_dir = options.results_dir,
                           .command = command_line(),
                           .show_progress = true};
  const FoundSources found = find_sources(options.paths, options.jobs);
  if (found.interrupted) return kInterruptedExit;
  tell(found);
  const CampaignSummary summary = run_campaign(campaign, found.problems, solvers);
  const int code = tell(summary);
  if (summary.interrupted) return code;
  print_rankings(load_records(options.results_dir));
  fmt::print(stderr, "conebench report {}  writes tables and profiles\n",
             options.results_dir.string());
  return code;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<RunOptions>();
  options->settings.time_limit = "10s";
  options->settings.memory_limit = "2G";
  CLI::App* verb = app.add_subcommand(
      "run", "Run a campaign: every solver on every problem, one process a task; resumable");
  verb->add_option("-p,--problems", options->paths, "Problem files or folders")->required();
  verb->add_option("-s,--solver", options->solvers, "Variants; lists make grids: gs[omega=0.8,1]")
      ->required();
  options->settings.add_to(*verb);
  verb->add_option("--reps", options->repetitions, "Times that each task is run")
      ->capture_default_str();
  verb->add_option("--seed", options->seed, "Of the random order of the tasks")
      ->capture_default_str();
  verb->add_option("--jobs", options->jobs, "Tasks at a time; keep 1 for fair timing")
      ->capture_default_str();
  verb->add_option("--rerun", options->rerun,
                   "Finished tasks to run again: none, failed, timeouts or all")
      ->capture_default_str();
  verb->add_option("-o,--output", options->results_dir, "Results folder")->capture_default_str();
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace conebench::harness
