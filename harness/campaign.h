#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "harness/worker.h"
#include "results/journal.h"

namespace conebench::harness {

/// Which tasks that the journal already holds are done once more.
enum class Rerun {
  kNone,
  kFailed,    ///< those whose verified eta is above the tolerance; of models those that did not
              ///< converge; never a proof that there is no solution
  kTimeouts,  ///< those that ended as time_limit or killed_time
  kAll,
};

/// "none", "failed", "timeouts", "all". Throws problems::InputError.
Rerun rerun_from(const std::string& name);

/// How a campaign, or one shard of it, is run.
struct CampaignOptions {
  std::filesystem::path results_dir{};
  results::Shard shard{};
  int jobs = 1;  ///< tasks at a time; 1 for fair timing
  Rerun rerun = Rerun::kNone;
  std::string command{};  ///< what the report shall say made the results
  bool show_progress = false;
};

struct CampaignSummary {
  std::size_t tasks = 0;           ///< given
  std::size_t earlier = 0;         ///< of them already in the journals, and kept
  std::size_t done = 0;            ///< by this call
  std::vector<std::string> lost;   ///< tasks that could not run at all, one line each
  std::vector<std::string> drift;  ///< signs that the machine was not equally fast throughout
  bool interrupted = false;
};

/// Runs the tasks in the given order, each in a worker process. The records of each finished task
/// are in the journal of the shard before another one starts. Tasks that any journal in the folder
/// holds are not run again, so that a campaign that was killed, or is cut into other shards, goes
/// on where it stopped. Throws problems::OutputError when the results cannot be kept,
/// problems::InputError for more jobs times threads than there are cores.
CampaignSummary run_campaign(const CampaignOptions& options, std::vector<Task> tasks);

/// Which of the tasks the records do not hold, or hold and shall be run again.
std::vector<Task> open_tasks(std::vector<Task> tasks, const std::vector<results::Record>& records,
                             Rerun rerun);

}  // namespace conebench::harness
