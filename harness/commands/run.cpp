#include <fmt/format.h>

#include <memory>

#include "harness/campaign.h"
#include "harness/command_line.h"
#include "harness/commands/commands.h"
#include "harness/interrupt.h"
#include "harness/study_options.h"
#include "harness/summary.h"
#include "harness/tasks.h"

namespace conebench::harness {
namespace {

struct RunOptions {
  StudyOptions study;
  int jobs = 1;
  std::string shard = "1/1", rerun = "none";
  std::filesystem::path results_dir = "results";
};

int run(const RunOptions& options) {
  const CampaignOptions campaign{.results_dir = options.results_dir,
                                 .shard = shard_from(options.shard),
                                 .jobs = options.jobs,
                                 .rerun = rerun_from(options.rerun),
                                 .command = command_line(),
                                 .show_progress = true};
  const auto plan = find_plan(options.study, options.results_dir, options.jobs);
  if (!plan) return kInterruptedExit;
  std::vector<Task> tasks = tasks_of_shard(groups_of(*plan).groups, campaign.shard);
  shuffle(tasks, plan->study.seed);
  const CampaignSummary summary = run_campaign(campaign, std::move(tasks));
  const int code = tell(summary);
  if (summary.interrupted || campaign.shard.count > 1) return code;
  print_rankings(load_records(options.results_dir));
  fmt::print(stderr, "conebench report {}  writes tables and profiles\n",
             options.results_dir.string());
  return code;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<RunOptions>();
  CLI::App* verb = app.add_subcommand(
      "run", "Run a campaign: every solver on every problem, one process a task; resumable");
  options->study.add_to(*verb);
  verb->add_option("--shard", options->shard, "Part i of n, e.g. 3/20")
      ->type_name("I/N")
      ->capture_default_str();
  verb->add_option("--jobs", options->jobs, "Tasks at a time; keep 1 for fair timing")
      ->capture_default_str();
  verb->add_option("--rerun", options->rerun,
                   "Finished tasks to run again: none, failed, timeouts or all")
      ->type_name("none|failed|timeouts|all")
      ->capture_default_str();
  verb->add_option("-o,--output", options->results_dir,
                   "Results folder; without -p and -c its plan.json says what to run")
      ->type_name("DIR")
      ->capture_default_str();
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace conebench::harness
