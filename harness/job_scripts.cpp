#include "harness/job_scripts.h"

#include <fmt/format.h>

#include <cmath>

#include "results/output.h"

namespace conebench::harness {
namespace {

constexpr double kSlack_s = 600.0;         // to start, to load, to write
constexpr double kWallOfSolverTime = 2.0;  // residuals are outside of the solvers' clocks

// For a POSIX shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string shard_command(const ShardedRun& run, const std::string& index) {
  return fmt::format("{} run -o {} --shard {}/{}", quoted(run.program),
                     quoted(run.results_dir.string()), index, run.shards);
}

std::string merge_command(const ShardedRun& run) {
  return fmt::format("{} merge {}", quoted(run.program), quoted(run.results_dir.string()));
}

std::string slurm_shards(const ShardedRun& run) {
  const double wall_s = kWallOfSolverTime * run.shard_s + kSlack_s;
  const auto minutes = static_cast<long>(std::ceil(wall_s / 60.0));
  return fmt::format(R"(#!/bin/bash
#SBATCH --job-name=conebench
#SBATCH --array=1-{}
#SBATCH --nodes=1
#SBATCH --ntasks=1
#SBATCH --cpus-per-task={}
#SBATCH --exclusive
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --time={}
#SBATCH --output=shard-%a.log
exec srun --cpu-bind=cores {}
)",
                     run.shards, run.threads, minutes,
                     shard_command(run, "\"$SLURM_ARRAY_TASK_ID\""));
}

std::string slurm_merge(const ShardedRun& run) {
  return fmt::format(R"(#!/bin/bash
#SBATCH --job-name=conebench-merge
#SBATCH --ntasks=1
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output=merge.log
exec {}
)",
                     merge_command(run));
}

// `afterany`: what some shards lack shows in `conebench status`, and does not hold back the rest.
std::string slurm_submit(const ShardedRun& run) {
  return fmt::format(R"(#!/bin/bash
set -eu
cd {}
shards=$(sbatch --parsable slurm-shards.sh)
merge=$(sbatch --parsable --dependency=afterany:"$shards" slurm-merge.sh)
echo "shards: job $shards, merge: job $merge"
)",
                     quoted(run.results_dir.string()));
}

std::string parallel(const ShardedRun& run) {
  return fmt::format(R"(#!/bin/bash
# GNU parallel; PARALLEL_HOSTS: as its --sshlogin takes them, e.g. "node1,node2"
set -eu
cd {}
seq 1 {} | parallel --jobs 1 ${{PARALLEL_HOSTS:+--sshlogin "$PARALLEL_HOSTS"}} \
  --joblog parallel.log {}
{}
)",
                     quoted(run.results_dir.string()), run.shards, quoted(shard_command(run, "{}")),
                     merge_command(run));
}

std::string loop(const ShardedRun& run) {
  return fmt::format(R"(#!/bin/bash
set -eu
for shard in $(seq 1 {}); do
  {}
done
{}
)",
                     run.shards, shard_command(run, "\"$shard\""), merge_command(run));
}

}  // namespace

std::vector<std::filesystem::path> write_job_scripts(const ShardedRun& run) {
  const std::vector<std::pair<std::string, std::string>> scripts = {
      {"slurm-shards.sh", slurm_shards(run)},
      {"slurm-merge.sh", slurm_merge(run)},
      {"slurm-submit.sh", slurm_submit(run)},
      {"parallel.sh", parallel(run)},
      {"loop.sh", loop(run)}};
  std::vector<std::filesystem::path> written;
  for (const auto& [name, text] : scripts) {
    written.push_back(run.results_dir / name);
    results::write_text_file(written.back(), text);
  }
  return written;
}

}  // namespace conebench::harness
