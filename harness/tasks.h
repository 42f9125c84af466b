#pragma once

#include <string>
#include <vector>

#include "harness/study.h"
#include "results/journal.h"

namespace conebench::harness {

/// All tasks of one problem, or of one sequence of steps: they run in one shard, on one host, so
/// that solvers are compared on one machine.
struct TaskGroup {
  std::string id;     ///< content hash of the problem, or of the sequence
  double size = 0.0;  ///< how much there is to solve: cones times tasks
  std::vector<Task> tasks;
};

/// The tasks of a plan on these problems.
struct TaskGroups {
  std::vector<TaskGroup> groups;
  std::size_t without_guess = 0;     ///< problems that mode `warm` leaves out
  std::size_t without_sequence = 0;  ///< problems that mode `sequence` leaves out
};

TaskGroups make_task_groups(const Plan& plan, const std::vector<ProblemSource>& problems);

/// The consecutive steps of each scene, at least two: of problems of one family, sorted by step,
/// those that follow each other at the smallest distance in that family.
std::vector<std::vector<ProblemSource>> find_sequences(std::vector<ProblemSource> problems);

/// The tasks of one shard: groups, the largest first, go to the shard with the least to solve. The
/// same groups give the same shards on every machine. Throws problems::InputError for an index
/// outside 1 to count.
std::vector<Task> tasks_of_shard(std::vector<TaskGroup> groups, results::Shard shard);

/// In a random order, the same for the same seed everywhere.
void shuffle(std::vector<Task>& tasks, std::uint64_t seed);

/// "3/20": shard 3 of 20. Throws problems::InputError.
results::Shard shard_from(const std::string& text);

}  // namespace conebench::harness
