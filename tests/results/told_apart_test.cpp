#include "results/told_apart.h"

#include <gtest/gtest.h>

#include <cmath>

#include "random_records.h"
#include "results/bootstrap.h"
#include "results/noise.h"
#include "results/tails.h"

namespace conebench::results {
namespace {

TEST(Bootstrap, OfAMeanIsTheNormalIntervalForManyScenes) {
  std::vector<double> values, ones(400, 1.0);
  for (int i = 0; i < 400; ++i) values.push_back(i % 2);
  const Interval found = *bootstrap(400, ratio_of_sums(values, ones));
  // 0.5 -+ 1.96 * 0.5 / sqrt(400) = 0.451 to 0.549; 2000 resamples place each end to about 0.002.
  EXPECT_NEAR(found.low, 0.451, 0.006);
  EXPECT_NEAR(found.high, 0.549, 0.006);
}

TEST(Bootstrap, CopiesOfAStepAddNoCertainty) {
  // Ten scenes; in the second case each has 100 identical steps. The interval must not shrink.
  std::vector<double> few, many, one(10, 1.0), hundred(10, 100.0);
  for (int i = 0; i < 10; ++i) {
    few.push_back(i % 2);
    many.push_back(100.0 * (i % 2));
  }
  const Interval a = *bootstrap(10, ratio_of_sums(few, one));
  const Interval b = *bootstrap(10, ratio_of_sums(many, hundred));
  EXPECT_DOUBLE_EQ(a.low, b.low);
  EXPECT_DOUBLE_EQ(a.high, b.high);
  EXPECT_GT(a.high - a.low, 0.5);
}

TEST(Bootstrap, HasNoIntervalForTooFewScenes) {
  const Statistic mean = ratio_of_sums({0.0, 1.0, 0.0, 1.0}, {1.0, 1.0, 1.0, 1.0});
  EXPECT_FALSE(bootstrap(4, mean).has_value());
}

TEST(Bootstrap, WhatIsUndefinedWidensTheIntervalAtBothEnds) {
  // Only one of five scenes says anything: a third of the resamples, (4/5)^5, say nothing.
  const Interval found = *bootstrap(5, ratio_of_sums({1, 0, 0, 0, 0}, {1, 0, 0, 0, 0}));
  EXPECT_TRUE(std::isinf(found.low) && found.low < 0);
  EXPECT_TRUE(std::isinf(found.high) && found.high > 0);
}

TEST(Bootstrap, IsTheSameForTheSameSeed) {
  const Statistic mean = ratio_of_sums({1, 2, 3, 4, 5, 6}, {1, 1, 1, 1, 1, 1});
  EXPECT_EQ(bootstrap(6, mean, 7)->low, bootstrap(6, mean, 7)->low);
}

TEST(Scenes, AProblemWithoutAFamilyIsASceneOfItsOwn) {
  Record a = make_record("p1", "s", 1e-9, 1), b = make_record("p2", "s", 1e-9, 1);
  EXPECT_EQ(scene_of(a.problem), scene_of(b.problem));
  a.problem.family = b.problem.family = "";
  EXPECT_NE(scene_of(a.problem), scene_of(b.problem));
}

TEST(NoiseFloor, IsOneWithoutNoiseAndNothingWithoutRepetitions) {
  const std::vector<std::vector<double>> steady = {{1.0, 1.0}, {2.0, 2.0, 2.0}};
  EXPECT_DOUBLE_EQ(*noise_floor(steady), 1.0);
  const std::vector<std::vector<double>> single = {{1.0}, {2.0}};
  EXPECT_FALSE(noise_floor(single).has_value());
}

TEST(NoiseFloor, OfOneTaskRunTwiceIsItsRatio) {
  const std::vector<std::vector<double>> twice = {{1.0, 1.25}};
  EXPECT_DOUBLE_EQ(*noise_floor(twice), 1.25);
}

// Two identical solvers, drawn from the same distribution: the floor holds their ratio.
TEST(NoiseFloor, HoldsTheRatioOfTwoIdenticalSolvers) {
  int inside = 0;
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    std::mt19937 random(seed);
    std::lognormal_distribution<double> noise(0.0, 0.1);
    std::vector<std::vector<double>> first(30);
    double log_ratio = 0.0;
    for (auto& task : first) {
      std::vector<double> second;
      for (int repetition = 0; repetition < 10; ++repetition) {
        task.push_back(noise(random));
        second.push_back(noise(random));
      }
      log_ratio += std::log(order_statistic(task, 0.5) / order_statistic(second, 0.5)) / 30.0;
    }
    const double floor = *noise_floor(first);
    EXPECT_LT(floor, 1.1);
    inside += std::abs(log_ratio) <= std::log(floor);
  }
  EXPECT_GE(inside, 36);  // 95 % would be 38; with half the repetitions the floor is wider still
}

TimeTable table_of(const std::vector<Record>& records) { return make_time_table(records, 1e-8); }

SolverPair pair_of(const std::vector<Record>& records) {
  return compare_pair(table_of(records), repeated_times(records, 1e-8), 0, 1);
}

// Both solve everything; b takes `factor` times as long, the same on every scene.
std::vector<Record> two_solvers(double factor, int scenes = 8) {
  std::vector<Record> records;
  for (int scene = 0; scene < scenes; ++scene) {
    const std::string problem = "p" + std::to_string(scene);
    for (const auto& [solver, time_s] :
         {std::pair("a", 0.1 + scene), {"b", factor * (0.1 + scene)}}) {
      records.push_back(make_record(problem, solver, 1e-9, time_s));
      records.back().problem.family = "dem/" + problem;
      records.back().settings.time_limit_s = 1e6;
    }
  }
  return records;
}

TEST(ToldApart, ByTimeWhenEverySceneAgreesAndTheNoiseIsSmaller) {
  const SolverPair pair = pair_of(two_solvers(2.0));
  EXPECT_NEAR(*pair.time_ratio, 0.5, 1e-12);
  EXPECT_TRUE(pair.told_apart_by_time());
  EXPECT_FALSE(pair.told_apart_by_share());
  EXPECT_FALSE(pair.noise_is_measured);
}

TEST(ToldApart, NeverInsideTheNoise) {
  EXPECT_FALSE(pair_of(two_solvers(1.05)).told_apart());  // 1.10 is assumed
  auto records = two_solvers(1.5);
  for (Record copy : two_solvers(1.5)) {  // the second repetition takes twice as long
    copy.repetition = 1;
    copy.solve_s *= 2.0;
    records.push_back(copy);
  }
  auto noisy = pair_of(records);
  EXPECT_TRUE(noisy.noise_is_measured);
  for (Record& record : records) {
    if (record.problem.name != "p0")
      record.settings.time_limit_s = 0.0;  // one task left: all noise
  }
  noisy = pair_of(records);
  EXPECT_DOUBLE_EQ(noisy.noise, 2.0);
  EXPECT_FALSE(noisy.told_apart());
}

TEST(ToldApart, NeverWithTooFewScenes) {
  EXPECT_FALSE(pair_of(two_solvers(100.0, 4)).told_apart());
  EXPECT_TRUE(pair_of(two_solvers(100.0, 5)).told_apart());
}

TEST(ToldApart, ByShareWhenOneSolvesMore) {
  auto records = two_solvers(1.0, 10);
  for (Record& record : records) {
    if (record.solver == "b" && record.problem.name != "p0") record.eta = 1e-3;
  }
  const SolverPair pair = pair_of(records);
  EXPECT_DOUBLE_EQ(pair.share_difference, 0.9);
  EXPECT_TRUE(pair.told_apart_by_share());
}

TEST(ToldApart, LooksOnlyAtProblemsThatBothWereRunOn) {
  auto records = two_solvers(2.0);
  std::erase_if(records, [](const Record& r) { return r.solver == "b" && r.problem.name == "p7"; });
  const SolverPair pair = pair_of(records);
  EXPECT_EQ(pair.problems, 7);
  EXPECT_EQ(pair.share_difference, 0.0);
}

TEST(ToldApart, CopiesOfASolverAreNeverToldApart) {
  for (std::uint32_t seed = 0; seed < 10; ++seed) {
    auto records = random_records(seed, {.solvers = 1});
    for (Record copy : random_records(seed, {.solvers = 1})) {
      copy.solver = "twin";
      records.push_back(copy);
    }
    EXPECT_FALSE(pair_of(records).told_apart()) << seed;
  }
}

}  // namespace
}  // namespace conebench::results
