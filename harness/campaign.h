#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/problem_id.h"
#include "harness/worker.h"
#include "solvers/solver.h"

namespace conebench::harness {

/// Which tasks that the journal already holds are done once more.
enum class Rerun {
  kNone,
  kFailed,    ///< those whose verified eta is above the tolerance
  kTimeouts,  ///< those that ended as time_limit or killed_time
  kAll,
};

/// "none", "failed", "timeouts", "all". Throws problems::InputError.
Rerun rerun_from(const std::string& name);

/// The settings of a campaign; one set for all of its tasks.
struct CampaignOptions {
  solvers::Stop stop{};
  std::uint64_t memory_limit_bytes = 0;
  std::optional<double> hard_limit_s{};  ///< of a task; default_hard_limit_s() unless given
  int repetitions = 1;
  std::uint64_t seed = 1;  ///< of the order in which the tasks run
  int jobs = 1;            ///< at a time; 1 for fair timing
  Rerun rerun = Rerun::kNone;
  std::filesystem::path results_dir{};
  std::string command{};  ///< what the report shall say made the results
  bool show_progress = false;
};

struct CampaignSummary {
  std::size_t tasks = 0;          ///< problems x solvers x repetitions
  std::size_t earlier = 0;        ///< of them already in the journal, and kept
  std::size_t done = 0;           ///< by this call
  std::vector<std::string> lost;  ///< tasks that could not run at all, one line each
  bool interrupted = false;
};

/// Runs every solver on every problem, each task in a worker process, in a random interleaved
/// order, so that a drift of the machine's speed hurts all solvers alike. Each finished task is a
/// synced line in the journal before the next one starts; a campaign that was killed goes on where
/// it stopped. Throws problems::OutputError when the results cannot be kept.
CampaignSummary run_campaign(const CampaignOptions& options,
                             const std::vector<ProblemSource>& problems,
                             const std::vector<solvers::Solver>& solvers);

/// RESULTS_DIR/campaign.json's "command"; empty if there is none.
std::string campaign_command(const std::filesystem::path& results_dir);

}  // namespace conebench::harness
