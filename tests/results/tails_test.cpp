#include "results/tails.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "random_records.h"
#include "results/deadlines.h"
#include "results/shares.h"

namespace conebench::results {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

std::vector<double> one_to(int last) {
  std::vector<double> values(static_cast<std::size_t>(last));
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

TEST(OrderStatistic, IsTheSmallestValueThatTheShareDoesNotExceed) {
  EXPECT_EQ(order_statistic(one_to(100), 0.5), 50.0);
  EXPECT_EQ(order_statistic(one_to(100), 0.99), 99.0);
  EXPECT_EQ(order_statistic(one_to(100), 0.07), 7.0);  // 0.07 * 100 > 7 in floating point
  EXPECT_EQ(order_statistic(one_to(100), 0.999), 100.0);
  EXPECT_EQ(order_statistic(one_to(4), 0.5), 2.0);
  EXPECT_EQ(order_statistic(one_to(5), 0.5), 3.0);
  EXPECT_EQ(order_statistic({7.0}, 0.001), 7.0);
}

TEST(Tails, APercentileAmongFailuresIsInfiniteAndNeverTheLimit) {
  std::vector<double> times_s = one_to(1000);
  for (std::size_t i = 990; i < 1000; ++i) times_s[i] = kNever;  // 1 % failures
  const Tails found = *tails(times_s);
  EXPECT_EQ(found.p50, 500.0);
  EXPECT_EQ(found.p90, 900.0);
  EXPECT_EQ(found.p99, 990.0);
  EXPECT_EQ(found.p99_9, kNever);
  EXPECT_EQ(found.max, kNever);
  EXPECT_EQ(found.failures, 10u);
  EXPECT_FALSE(tails({}).has_value());
}

TEST(Tails, NeverImproveWhenATaskFailsMore) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    std::mt19937 random(seed);
    std::vector<double> times_s = one_to(1 + static_cast<int>(random() % 40));
    const Tails before = *tails(times_s);
    times_s.push_back(kNever);
    const Tails after = *tails(times_s);
    for (const auto member : {&Tails::p50, &Tails::p90, &Tails::p99, &Tails::p99_9, &Tails::max}) {
      EXPECT_GE(after.*member, before.*member) << seed;
    }
    EXPECT_EQ(after.max, kNever);
  }
}

TEST(ResidualMean, IsGeometricOverTheSolvedAndCountsTheOthersApart) {
  const std::vector<Record> records = {make_record("p1", "a", 1e-9, 1),
                                       make_record("p2", "a", 0, 1), make_record("p3", "a", 0.5, 1),
                                       make_record("p4", "a", Record::kUnknown, 1)};
  const ResidualMean found = residual_mean(records);
  EXPECT_NEAR(std::log10(*found.mean), -12.5, 1e-12);  // sqrt(1e-9 1e-16): zero is floored
  EXPECT_EQ(found.solved, 2u);
  EXPECT_EQ(found.failed, 2u);
  EXPECT_EQ(found.unknown, 1u);
  EXPECT_EQ(*found.worst, 0.5);
}

// Nine excellent answers must not make a bad one look good: it is a failure, and it is the worst.
TEST(ResidualMean, OneBadCaseCannotHide) {
  std::vector<Record> records;
  for (int i = 0; i < 9; ++i) {
    records.push_back(make_record("p" + std::to_string(i), "a", 1e-15, 1));
  }
  const double mean_before = *residual_mean(records).mean;
  records.push_back(make_record("bad", "a", 0.9, 1));
  const ResidualMean found = residual_mean(records);
  EXPECT_EQ(found.failed, 1u);
  EXPECT_EQ(*found.worst, 0.9);
  EXPECT_EQ(*found.mean, mean_before);  // and neither does it leak into what is said of the others
}

// p1: a 1 s, b 4 s; p2: a fails, b 2 s; sizes 10 and 100 cones.
std::vector<Record> two_problems() {
  std::vector<Record> records = {
      make_record("p1", "a", 1e-9, 1.0), make_record("p1", "b", 1e-9, 4.0),
      make_record("p2", "a", 1e-3, 9.0), make_record("p2", "b", 1e-9, 2.0)};
  for (Record& record : records) record.problem.cones = record.problem.name == "p1" ? 10 : 100;
  return records;
}

TEST(Shares, DataProfilesCountTimePerCone) {
  const auto profiles = data_profiles(make_time_table(two_problems(), 1e-8));
  ASSERT_EQ(profiles[0].size(), 1u);
  EXPECT_DOUBLE_EQ(profiles[0][0].value, 0.1);
  EXPECT_DOUBLE_EQ(profiles[0][0].share, 0.5);
  ASSERT_EQ(profiles[1].size(), 2u);
  EXPECT_DOUBLE_EQ(profiles[1][0].value, 0.02);
  EXPECT_DOUBLE_EQ(profiles[1][1].value, 0.4);
  EXPECT_DOUBLE_EQ(profiles[1][1].share, 1.0);
}

TEST(Shares, DataProfilesDoNotDependOnWhoElseIsShown) {
  const TimeTable table = make_time_table(two_problems(), 1e-8);
  const auto alone = data_profiles(without_solver(table, 0));
  const auto both = data_profiles(table);
  ASSERT_EQ(alone[0].size(), both[1].size());
  for (std::size_t i = 0; i < alone[0].size(); ++i) {
    EXPECT_EQ(alone[0][i].value, both[1][i].value);
    EXPECT_EQ(alone[0][i].share, both[1][i].share);
  }
}

TEST(Shares, TheDistributionOfTimesEndsAtTheShareSolved) {
  const auto distributions = time_distributions(make_time_table(two_problems(), 1e-8));
  ASSERT_EQ(distributions[0].size(), 1u);
  EXPECT_DOUBLE_EQ(distributions[0][0].value, 1.0);
  EXPECT_DOUBLE_EQ(distributions[0].back().share, 0.5);
  EXPECT_DOUBLE_EQ(distributions[1].back().share, 1.0);
}

TEST(Shares, SolvedCountsFallWithTheTolerance) {
  const auto counts = solved_counts(two_problems(), 1e-8);
  ASSERT_EQ(counts.tolerances.size(), 8u);
  EXPECT_DOUBLE_EQ(counts.tolerances.front(), 0.1);
  EXPECT_EQ(counts.tolerances.back(), 1e-8);
  EXPECT_EQ(counts.problems, 2);
  EXPECT_EQ(counts.solved[0].front(), 2);  // 1e-3 is within 0.1
  EXPECT_EQ(counts.solved[0].back(), 1);
  EXPECT_EQ(counts.solved[1].back(), 2);
  for (const auto& solved : counts.solved)
    EXPECT_TRUE(std::is_sorted(solved.rbegin(), solved.rend()));
}

TEST(Shares, TheLadderHasEachDecadeOnceAndEndsAtTheTolerance) {
  EXPECT_THAT(tolerance_ladder(1e-3),
              testing::ElementsAre(testing::DoubleEq(0.1), testing::DoubleEq(0.01), 1e-3));
  EXPECT_THAT(tolerance_ladder(5e-3),
              testing::ElementsAre(testing::DoubleEq(0.1), testing::DoubleEq(0.01), 5e-3));
  EXPECT_THAT(tolerance_ladder(0.5), testing::ElementsAre(0.5));
}

TEST(Deadlines, TheAnswerHeldIsTheBestOfTheCurveUntilThen) {
  Record record = make_record("p", "a", 1e-9, 4.0);
  record.curve = {{1.0, 5, 1e-3}, {2.0, 10, 1e-2}, {4.0, 20, 1e-9}};
  EXPECT_EQ(eta_at(record, 0.5), kNever);
  EXPECT_EQ(eta_at(record, 1.0), 1e-3);
  EXPECT_EQ(eta_at(record, 3.0), 1e-3);  // the best so far, not the last
  EXPECT_EQ(eta_at(record, 4.0), 1e-9);
}

TEST(Deadlines, NoCurveIsBelievedBeyondTheVerifiedAnswer) {
  Record record = make_record("p", "a", 1e-3, 4.0);
  record.curve = {{1.0, 5, 1e-12}};
  EXPECT_EQ(eta_at(record, 2.0), 1e-3);
  record.curve.clear();
  EXPECT_EQ(eta_at(record, 2.0), kNever);
  EXPECT_EQ(eta_at(record, 4.0), 1e-3);
}

TEST(Deadlines, ACrashMissesEveryDeadline) {
  std::vector<Record> records = {make_record("p1", "a", 1e-9, 0.001),
                                 make_record("p2", "a", Record::kUnknown, 0.0)};
  const auto rows = deadline_rows(records, 1.0);
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].tasks, 2u);
  EXPECT_EQ(rows[0].missed, 1u);
  EXPECT_DOUBLE_EQ(rows[0].miss_rate(), 0.5);
  EXPECT_EQ(rows[0].median_eta, 1e-9);
  EXPECT_EQ(rows[0].p90_eta, kNever);
}

TEST(Deadlines, MissesNeverRiseWithTheDeadline) {
  const auto records = random_records(3);
  std::size_t before = records.size();
  for (const double deadline_s : {1e-5, 1e-3, 1e-2, 1e-1, 10.0}) {
    std::size_t missed = 0;
    for (const DeadlineRow& row : deadline_rows(records, deadline_s)) missed += row.missed;
    EXPECT_LE(missed, before) << deadline_s;
    before = missed;
  }
}

}  // namespace
}  // namespace conebench::results
