#include "harness/tasks.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "problems/error.h"
#include "test_solvers.h"

namespace conebench::harness {
namespace {

ProblemSource step_of(const std::string& family, std::int64_t step) {
  ProblemSource source = source_named(family + std::to_string(step));
  source.id.family = family;
  source.step = step;
  return source;
}

std::vector<std::vector<std::int64_t>> steps_of(const std::vector<ProblemSource>& problems) {
  std::vector<std::vector<std::int64_t>> steps;
  for (const auto& sequence : find_sequences(problems)) {
    steps.emplace_back();
    for (const ProblemSource& problem : sequence) steps.back().push_back(problem.step);
  }
  return steps;
}

TEST(Sequences, AreStepsAtTheSmallestDistanceOfTheirFamily) {
  using Steps = std::vector<std::vector<std::int64_t>>;
  EXPECT_EQ(steps_of({step_of("a", 3), step_of("a", 1), step_of("a", 2)}), (Steps{{1, 2, 3}}));
  EXPECT_EQ(steps_of({step_of("a", 10), step_of("a", 20), step_of("a", 40), step_of("a", 50)}),
            (Steps{{10, 20}, {40, 50}}));
  EXPECT_EQ(steps_of({step_of("a", 1), step_of("b", 2)}), Steps{});
  EXPECT_EQ(steps_of({step_of("", 1), step_of("", 2)}), Steps{});
  EXPECT_EQ(steps_of({step_of("a", 1), step_of("a", 2), step_of("a", 9)}), (Steps{{1, 2}}));
}

TEST(TaskGroups, HoldEveryCombinationOnce) {
  Plan plan = small_plan({honest_solver(), solver_that("other", [](auto&) {})});
  plan.stops.push_back({.tol = 1e-4, .time_limit_s = 1.0});
  plan.modes = {Mode::kCold, Mode::kWarm, Mode::kSequence};
  plan.donors = {std::nullopt, honest_solver()};
  plan.repetitions = 3;
  std::vector<ProblemSource> problems = {step_of("a", 1), step_of("a", 2), step_of("b", 1)};
  problems[0].has_guess = true;
  const TaskGroups all = make_task_groups(plan, problems);
  EXPECT_EQ(all.without_guess, 2u);
  EXPECT_EQ(all.without_sequence, 1u);
  std::multiset<std::string> keys;
  std::map<Mode, int> count;
  for (const TaskGroup& group : all.groups) {
    for (const Task& task : group.tasks) {
      keys.insert(results::sequence_key(blank_records(task).front()));
      ++count[task.mode];
    }
  }
  // 2 solvers, 2 tolerances, 3 repetitions; in the sequence `honest` has itself as donor only once.
  EXPECT_EQ(count[Mode::kCold], 3 * 12);
  EXPECT_EQ(count[Mode::kWarm], 12);
  EXPECT_EQ(count[Mode::kSequence], 6 + 12);
  EXPECT_EQ(std::set<std::string>(keys.begin(), keys.end()).size(), keys.size());
}

TEST(Shards, CutGroupsWholeAndEvenlyAndTheSameEverywhere) {
  std::vector<ProblemSource> problems;
  for (int i = 0; i < 23; ++i) {
    problems.push_back(step_of("a", i));
    problems.back().id.cones = 1 + i * i;
  }
  const Plan plan = small_plan({honest_solver(), solver_that("other", [](auto&) {})});
  auto groups = make_task_groups(plan, problems).groups;
  std::map<std::string, std::set<int>> shards_of_problem;
  std::vector<double> load(4, 0.0);
  std::size_t tasks = 0;
  for (int i = 1; i <= 4; ++i) {
    for (const Task& task : tasks_of_shard(groups, {.index = i, .count = 4})) {
      shards_of_problem[task.problems->front().id.name].insert(i);
      load[static_cast<std::size_t>(i - 1)] += task.problems->front().id.cones;
      ++tasks;
    }
  }
  EXPECT_EQ(tasks, 46u);
  EXPECT_EQ(shards_of_problem.size(), 23u);
  for (const auto& [name, shards] : shards_of_problem) EXPECT_EQ(shards.size(), 1u) << name;
  // The rule of the longest first is within 4/3 of the best (Graham 1969), here near it.
  EXPECT_LT(*std::max_element(load.begin(), load.end()),
            1.1 * *std::min_element(load.begin(), load.end()));
  std::reverse(groups.begin(), groups.end());
  std::size_t same = 0;
  for (const Task& task : tasks_of_shard(groups, {.index = 2, .count = 4})) {
    same += shards_of_problem[task.problems->front().id.name].count(2);
  }
  EXPECT_EQ(same, tasks_of_shard(groups, {.index = 2, .count = 4}).size());
}

TEST(Shards, AreReadFromTheirText) {
  EXPECT_EQ(shard_from("3/20").index, 3);
  EXPECT_EQ(shard_from("3/20").count, 20);
  for (const char* text : {"", "3", "0/2", "3/2", "3/", "a/b", "1/2/3", "-1/2"}) {
    EXPECT_THROW(shard_from(text), problems::InputError) << text;
  }
}

TEST(Shuffle, IsTheSameForTheSameSeed) {
  std::vector<ProblemSource> problems;
  for (int i = 0; i < 30; ++i) problems.push_back(step_of("a", i));
  Plan plan = small_plan({honest_solver()});
  const auto order = [&](std::uint64_t seed) {
    plan.seed = seed;
    std::vector<std::int64_t> steps;
    for (const Task& task : tasks_of(plan, problems)) steps.push_back((*task.problems)[0].step);
    return steps;
  };
  EXPECT_EQ(order(1), order(1));
  EXPECT_NE(order(1), order(2));
  EXPECT_NE(order(1).front(), order(1)[1] - 1);
}

}  // namespace
}  // namespace conebench::harness
