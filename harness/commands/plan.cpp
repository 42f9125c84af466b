#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "harness/commands/commands.h"
#include "harness/interrupt.h"
#include "harness/job_scripts.h"
#include "harness/study_options.h"
#include "results/text.h"

namespace conebench::harness {
namespace {

constexpr double kShard_s = 1200.0;  // 20 minutes

struct PlanOptions {
  StudyOptions study;
  std::filesystem::path results_dir = "results";
  int shards = 0, jobs = 1;
  bool slurm = false;
};

// The longest time of tasks in which every solve uses up its time limit.
double longest_s(const std::vector<Task>& tasks) {
  double sum = 0.0;
  for (const Task& task : tasks) {
    sum +=
        task.stop.time_limit_s * static_cast<double>(task.problems->size()) * (task.donor ? 2 : 1);
  }
  return sum;
}

int suggested_shards(const std::vector<TaskGroup>& groups) {
  double sum = 0.0;
  for (const TaskGroup& group : groups) sum += longest_s(group.tasks);
  const double shards = std::isfinite(sum) ? std::ceil(sum / kShard_s) : 1.0;
  return static_cast<int>(std::clamp(shards, 1.0, static_cast<double>(groups.size())));
}

int plan(const PlanOptions& options) {
  const auto found = find_plan(options.study, options.results_dir, options.jobs);
  if (!found) return kInterruptedExit;
  const TaskGroups all = groups_of(*found);
  const int shards = options.shards > 0 ? options.shards : suggested_shards(all.groups);
  results::TextTable table({"shard", "tasks", "at most"});
  std::size_t tasks = 0;
  double largest_s = 0.0;
  int threads = 1;
  for (int i = 1; i <= shards; ++i) {
    const std::vector<Task> part = tasks_of_shard(all.groups, {.index = i, .count = shards});
    const double time_s = longest_s(part);
    tasks += part.size();
    largest_s = std::max(largest_s, time_s);
    for (const Task& task : part) threads = std::max(threads, task.threads);
    table.add({fmt::format("{}/{}", i, shards), fmt::format("{}", part.size()),
               results::format_time(time_s)});
  }
  fmt::print("{}\n{} tasks in {} groups, each of one problem or one sequence of steps\n",
             table.text(), tasks, all.groups.size());
  if (!options.slurm) return 0;
  const ShardedRun run{.program = std::filesystem::read_symlink("/proc/self/exe").string(),
                       .results_dir = std::filesystem::absolute(options.results_dir),
                       .shards = shards,
                       .threads = threads,
                       .shard_s = largest_s};
  for (const auto& file : write_job_scripts(run)) fmt::print("{}\n", file.string());
  return 0;
}

}  // namespace

void add_plan(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<PlanOptions>();
  CLI::App* verb = app.add_subcommand(
      "plan", "List a campaign's tasks and write its plan, for shards on several machines");
  options->study.add_to(*verb);
  verb->add_option("--shards", options->shards,
                   "Parts to cut it into (default: of 20 minutes, were every time limit used up)")
      ->check(CLI::PositiveNumber);
  verb->add_flag(
      "--slurm,--scripts", options->slurm,
      "Also write scripts: a Slurm array job with its merge, GNU parallel, a plain loop");
  verb->add_option("--jobs", options->jobs, "Problems read at a time")->capture_default_str();
  verb->add_option("-o,--output", options->results_dir, "Results folder")
      ->type_name("DIR")
      ->capture_default_str();
  verb->callback([options, &exit_code] { exit_code = plan(*options); });
}

}  // namespace conebench::harness
