#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace conebench::harness {

/// A planned campaign as other programs' jobs: shards of `RESULTS_DIR/plan.json`.
struct ShardedRun {
  std::string program;                ///< absolute path of conebench
  std::filesystem::path results_dir;  ///< absolute
  int shards = 1;
  int threads = 1;       ///< cores of a shard
  double shard_s = 0.0;  ///< longest solver time of the largest shard, every limit used up
};

/// Writes into the results folder, and returns what it wrote:
///   slurm-shards.sh, slurm-merge.sh, slurm-submit.sh  an array job, one shard a task, alone on its
///       node, bound to its cores, requeued when its node fails, and a merge that waits for it;
///       `bash slurm-submit.sh` submits both
///   parallel.sh  the shards by GNU parallel, one at a time on each host of PARALLEL_HOSTS
///   loop.sh      the shards one after the other
/// A shard that was stopped is run again by the same script and goes on. Throws
/// problems::OutputError.
std::vector<std::filesystem::path> write_job_scripts(const ShardedRun& run);

}  // namespace conebench::harness
