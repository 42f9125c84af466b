#include "harness/campaign.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <csignal>
#include <map>
#include <numeric>
#include <optional>

#include "harness/diary.h"
#include "harness/progress.h"
#include "problems/error.h"
#include "results/journal.h"

namespace conebench::harness {
namespace {

using results::Record;
using results::Status;

constexpr int kAttempts = 3;  // of a task whose worker is killed from outside

// A model solves its own problem; a proof that there is no solution is an answer.
bool failed(const Record& record) {
  if (record.status == Status::kInfeasible) return false;
  return record.kind == "model" ? record.status != Status::kConverged : !record.solved();
}

bool run_again(const Record& record, Rerun rerun) {
  switch (rerun) {
    case Rerun::kNone:
      return false;
    case Rerun::kFailed:
      return failed(record);
    case Rerun::kTimeouts:
      return record.status == Status::kTimeLimit || record.status == Status::kKilledTime;
    case Rerun::kAll:
      return true;
  }
  return true;
}

// Neither the solver nor one of its limits ended it: an operator, or a system out of memory. Such a
// task is run again; if that is how it always ends, that is its result.
bool killed_from_outside(const ChildOutcome& outcome) {
  return outcome.signal == SIGKILL && !outcome.timed_out && !outcome.out_of_memory;
}

void check_cores(const std::vector<Task>& tasks, int jobs) {
  int threads = 1;
  for (const Task& task : tasks) threads = std::max(threads, task.threads);
  problems::require(threads == 1 || jobs == 1, "--jobs", jobs, " at a time with ", threads,
                    " threads, expected 1: threads of one task must not share cores with another");
  const auto cores = static_cast<int>(allowed_cores().size());
  problems::require(threads <= cores, "--threads", threads, ", expected at most the ", cores,
                    " cores of this process");
}

}  // namespace

Rerun rerun_from(const std::string& name) {
  if (name == "none") return Rerun::kNone;
  if (name == "failed") return Rerun::kFailed;
  if (name == "timeouts") return Rerun::kTimeouts;
  if (name == "all") return Rerun::kAll;
  throw problems::InputError("--rerun", "\"" + name + "\"; known: none, failed, timeouts, all");
}

std::vector<Task> open_tasks(std::vector<Task> tasks, const std::vector<Record>& records,
                             Rerun rerun) {
  std::map<std::string, bool> again;  // of a sequence, if any of its records wants it
  for (const Record& record : records)
    again[results::sequence_key(record)] |= run_again(record, rerun);
  std::erase_if(tasks, [&](const Task& task) {
    const auto found = again.find(results::sequence_key(blank_records(task).front()));
    return found != again.end() && !found->second;
  });
  return tasks;
}

CampaignSummary run_campaign(const CampaignOptions& options, std::vector<Task> tasks) {
  check_cores(tasks, options.jobs);
  results::Journal journal(results::journal_path(options.results_dir, options.shard));

  CampaignSummary summary;
  summary.tasks = tasks.size();
  tasks = open_tasks(std::move(tasks), results::read_results(options.results_dir).records,
                     options.rerun);
  summary.earlier = summary.tasks - tasks.size();
  ::malloc_trim(0);  // every fork copies what the reading of the journals has left behind

  if (tasks.empty()) return summary;
  Diary diary(options.results_dir, options.shard, options.command, options.jobs);
  diary.before();

  std::optional<Progress> progress;
  if (options.show_progress) progress.emplace("tasks", tasks.size());
  const auto keep = [&](const Task& task, const ChildOutcome& outcome) {
    try {
      const std::vector<Record> records = records_of(task, outcome);
      journal.append(records);
      ++summary.done;
      const auto solved = [](const Record& record) { return record.solved(); };
      if (progress) progress->finished_one(std::all_of(records.begin(), records.end(), solved));
    } catch (const problems::InputError& error) {
      summary.lost.push_back(fmt::format("{} on {}", task.solver->name, error.what()));
    }
  };
  const auto tick = [&] {
    journal.flush_if_due();
    if (progress) progress->show();
  };
  std::vector<std::size_t> open(tasks.size());
  std::iota(open.begin(), open.end(), std::size_t{0});
  for (int attempt = 1; !open.empty() && !summary.interrupted; ++attempt) {
    std::vector<std::size_t> again;
    const auto done = [&](std::size_t i, const ChildOutcome& outcome) {
      if (attempt < kAttempts && killed_from_outside(outcome)) {
        again.push_back(open[i]);
      } else {
        keep(tasks[open[i]], outcome);
      }
    };
    const auto make = [&](std::size_t i) { return job_of(tasks[open[i]]); };
    summary.interrupted =
        !run_pool(open.size(), options.jobs,
                  {.make = make, .done = done, .tick = tick, .tick_s = results::Journal::kAsk_s});
    open = std::move(again);
  }
  journal.flush();  // the calibration takes longer than a record may wait
  summary.drift = diary.after();
  return summary;
}

}  // namespace conebench::harness
