#include "harness/campaign.h"

#include <fmt/format.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <random>

#include "harness/host.h"
#include "harness/progress.h"
#include "problems/error.h"
#include "results/journal.h"
#include "results/output.h"

namespace conebench::harness {
namespace {

using results::Record;
using results::Status;

std::vector<Task> all_tasks(const CampaignOptions& options,
                            const std::vector<ProblemSource>& problems,
                            const std::vector<solvers::Solver>& solvers) {
  std::vector<Task> tasks;
  for (int repetition = 0; repetition < options.repetitions; ++repetition) {
    for (const ProblemSource& problem : problems) {
      for (const solvers::Solver& solver : solvers) {
        tasks.push_back({.problem = problem.id,
                         .load = problem.load,
                         .solver = solver,
                         .stop = options.stop,
                         .memory_limit_bytes = options.memory_limit_bytes,
                         .hard_limit_s = options.hard_limit_s,
                         .repetition = repetition});
      }
    }
  }
  return tasks;
}

// Fisher and Yates; std::shuffle may differ between libraries.
void shuffle(std::vector<Task>& tasks, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (std::size_t i = tasks.size(); i > 1; --i) std::swap(tasks[i - 1], tasks[random() % i]);
}

bool run_again(const Record& record, Rerun rerun) {
  switch (rerun) {
    case Rerun::kNone:
      return false;
    case Rerun::kFailed:
      return !record.solved();
    case Rerun::kTimeouts:
      return record.status == Status::kTimeLimit || record.status == Status::kKilledTime;
    case Rerun::kAll:
      return true;
  }
  return true;
}

std::vector<Task> open_tasks(std::vector<Task> tasks, const std::vector<Record>& records,
                             Rerun rerun) {
  std::map<std::string, const Record*> done;
  for (const Record& record : records) done[results::task_key(record)] = &record;
  std::erase_if(tasks, [&](const Task& task) {
    const auto found = done.find(results::task_key(blank_record(task)));
    return found != done.end() && !run_again(*found->second, rerun);
  });
  return tasks;
}

std::filesystem::path campaign_path(const std::filesystem::path& results_dir) {
  return results_dir / "campaign.json";
}

void write_campaign(const CampaignOptions& options) {
  const nlohmann::json about = {{"command", options.command},
                                {"seed", options.seed},
                                {"jobs", options.jobs},
                                {"started_at", utc_now()},
                                {"host", to_json(current_host())}};
  results::write_text_file(
      campaign_path(options.results_dir),
      about.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace

Rerun rerun_from(const std::string& name) {
  if (name == "none") return Rerun::kNone;
  if (name == "failed") return Rerun::kFailed;
  if (name == "timeouts") return Rerun::kTimeouts;
  if (name == "all") return Rerun::kAll;
  throw problems::InputError("--rerun", "\"" + name + "\"; known: none, failed, timeouts, all");
}

CampaignSummary run_campaign(const CampaignOptions& options,
                             const std::vector<ProblemSource>& problems,
                             const std::vector<solvers::Solver>& solvers) {
  options.stop.check();
  problems::require(options.repetitions >= 1, "--reps", options.repetitions, ", expected >= 1");
  const auto path = results::journal_path(options.results_dir);
  results::Journal journal(path);
  const results::JournalContent earlier = results::read_journal(path);
  write_campaign(options);

  std::vector<Task> tasks = all_tasks(options, problems, solvers);
  CampaignSummary summary;
  summary.tasks = tasks.size();
  tasks = open_tasks(std::move(tasks), earlier.records, options.rerun);
  summary.earlier = summary.tasks - tasks.size();
  shuffle(tasks, options.seed);

  std::optional<Progress> progress;
  if (options.show_progress) progress.emplace("tasks", tasks.size());
  const auto done = [&](std::size_t i, const ChildOutcome& outcome) {
    try {
      const Record record = record_of(tasks[i], outcome);
      journal.append(record);
      ++summary.done;
      if (progress) progress->finished_one(record.solved());
    } catch (const problems::InputError& error) {
      summary.lost.push_back(fmt::format("{} on {}", tasks[i].solver.name, error.what()));
    }
  };
  summary.interrupted = !run_pool(tasks.size(), options.jobs,
                                  {.make = [&](std::size_t i) { return job_of(tasks[i]); },
                                   .done = done,
                                   .tick =
                                       [&] {
                                         if (progress) progress->show();
                                       }});
  return summary;
}

std::string campaign_command(const std::filesystem::path& results_dir) {
  std::ifstream file(campaign_path(results_dir));
  const auto json = nlohmann::json::parse(file, nullptr, false);
  return json.is_object() ? json.value("command", std::string()) : std::string();
}

}  // namespace conebench::harness
