#include "harness/tasks.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>
#include <random>
#include <sstream>

#include "problems/error.h"

namespace conebench::harness {
namespace {

double cones_of(const std::vector<ProblemSource>& problems) {
  double cones = 0.0;
  for (const ProblemSource& problem : problems) cones += problem.id.cones;
  return cones;
}

std::string id_of(const std::vector<ProblemSource>& problems) {
  if (problems.size() == 1) return problems.front().id.content_sha256;
  std::string contents;
  for (const ProblemSource& problem : problems) contents += problem.id.content_sha256 + "\n";
  return results::short_hash(contents);
}

// Which donors a mode and solver have; only a sequence has any but the solver itself.
std::vector<std::optional<Shared<solvers::Solver>>> donors_of(const Plan& plan, Mode mode,
                                                              const solvers::Solver& solver) {
  if (mode != Mode::kSequence) return {std::nullopt};
  std::vector<std::optional<Shared<solvers::Solver>>> donors;
  bool own = false;
  for (const auto& donor : plan.donors) {
    if (donor && (*donor)->name != solver.name) {
      donors.push_back(donor);
    } else if (!own) {
      own = true;
      donors.emplace_back(std::nullopt);
    }
  }
  return donors;
}

void add_tasks(const Plan& plan, Mode mode, const SharedList<ProblemSource>& problems,
               TaskGroup& group) {
  for (int repetition = 0; repetition < plan.repetitions; ++repetition) {
    for (const solvers::Stop& stop : plan.stops) {
      for (const int threads : plan.threads) {
        for (const auto& solver : plan.solvers) {
          for (const auto& donor : donors_of(plan, mode, *solver)) {
            group.tasks.push_back({.problems = problems,
                                   .solver = solver,
                                   .stop = stop,
                                   .mode = mode,
                                   .donor = donor,
                                   .threads = threads,
                                   .memory_limit_bytes = plan.memory_limit_bytes,
                                   .hard_limit_s = plan.hard_limit_s,
                                   .repetition = repetition,
                                   .repeat_for_confidence = plan.repeat_for_confidence});
          }
        }
      }
    }
  }
}

void finish(TaskGroup group, const std::vector<ProblemSource>& problems, TaskGroups& all) {
  if (group.tasks.empty()) return;
  group.id = id_of(problems);
  group.size = cones_of(problems) * static_cast<double>(group.tasks.size());
  all.groups.push_back(std::move(group));
}

void add_sequences(const Plan& plan, const std::vector<ProblemSource>& problems, TaskGroups& all) {
  std::size_t used = 0;
  for (const auto& steps : find_sequences(problems)) {
    used += steps.size();
    TaskGroup group;
    add_tasks(plan, Mode::kSequence, steps, group);
    finish(std::move(group), steps, all);
  }
  all.without_sequence = problems.size() - used;
}

}  // namespace

TaskGroups make_task_groups(const Plan& plan, const std::vector<ProblemSource>& problems) {
  TaskGroups all;
  for (const ProblemSource& problem : problems) {
    TaskGroup group;
    const SharedList<ProblemSource> one = {problem};
    for (const Mode mode : plan.modes) {
      if (mode == Mode::kSequence) continue;
      if (mode == Mode::kWarm && !problem.has_guess) {
        ++all.without_guess;
        continue;
      }
      add_tasks(plan, mode, one, group);
    }
    finish(std::move(group), {problem}, all);
  }
  const bool sequences =
      std::find(plan.modes.begin(), plan.modes.end(), Mode::kSequence) != plan.modes.end();
  if (sequences) add_sequences(plan, problems, all);
  return all;
}

std::vector<std::vector<ProblemSource>> find_sequences(std::vector<ProblemSource> problems) {
  std::map<std::string, std::vector<ProblemSource>> families;
  for (ProblemSource& problem : problems) {
    if (!problem.id.family.empty()) families[problem.id.family].push_back(std::move(problem));
  }
  std::vector<std::vector<ProblemSource>> sequences;
  for (auto& [name, steps] : families) {
    std::stable_sort(steps.begin(), steps.end(),
                     [](const auto& a, const auto& b) { return a.step < b.step; });
    std::int64_t distance = std::numeric_limits<std::int64_t>::max();
    for (std::size_t k = 1; k < steps.size(); ++k) {
      if (steps[k].step > steps[k - 1].step) {
        distance = std::min(distance, steps[k].step - steps[k - 1].step);
      }
    }
    std::vector<ProblemSource> run;
    for (ProblemSource& step : steps) {
      if (!run.empty() && step.step - run.back().step != distance) {
        if (run.size() > 1) sequences.push_back(run);
        run.clear();
      }
      run.push_back(std::move(step));
    }
    if (run.size() > 1) sequences.push_back(std::move(run));
  }
  return sequences;
}

std::vector<Task> tasks_of_shard(std::vector<TaskGroup> groups, results::Shard shard) {
  problems::require(shard.count >= 1 && shard.index >= 1 && shard.index <= shard.count, "--shard",
                    shard.index, "/", shard.count, ", expected i/n with 1 <= i <= n");
  std::sort(groups.begin(), groups.end(), [](const TaskGroup& a, const TaskGroup& b) {
    return a.size != b.size ? a.size > b.size : a.id < b.id;
  });
  std::vector<double> load(static_cast<std::size_t>(shard.count), 0.0);
  std::vector<Task> tasks;
  for (TaskGroup& group : groups) {
    const auto least = std::min_element(load.begin(), load.end());
    *least += group.size;
    if (least - load.begin() + 1 != shard.index) continue;
    for (Task& task : group.tasks) tasks.push_back(std::move(task));
  }
  return tasks;
}

// Fisher and Yates; std::shuffle may differ between libraries.
void shuffle(std::vector<Task>& tasks, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  for (std::size_t i = tasks.size(); i > 1; --i) std::swap(tasks[i - 1], tasks[random() % i]);
}

results::Shard shard_from(const std::string& text) {
  results::Shard shard;
  std::istringstream in(text);
  char slash = 0;
  const bool read = static_cast<bool>(in >> shard.index >> slash >> shard.count);
  problems::require(
      read && slash == '/' && in.peek() == EOF && shard.index >= 1 && shard.index <= shard.count,
      "--shard", "\"", text, "\"; expected i/n with 1 <= i <= n, e.g. 3/20");
  return shard;
}

}  // namespace conebench::harness
