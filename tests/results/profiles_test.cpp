#include "results/profiles.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "make_record.h"

namespace conebench::results {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

Record failed(const std::string& problem, const std::string& solver) {
  Record record = make_record(problem, solver, Record::kUnknown, 0.0);
  record.status = Status::kCrashed;
  return record;
}

// Four problems; times in seconds, "-" a failure:
//          a    b    c
//    p1    1    2    4
//    p2    3    -    3
//    p3    -    8    1
//    p4    -    -    -
std::vector<Record> example() {
  return {make_record("p1", "a", 1e-9, 1),
          make_record("p1", "b", 1e-9, 2),
          make_record("p1", "c", 1e-9, 4),
          make_record("p2", "a", 1e-9, 3),
          failed("p2", "b"),
          make_record("p2", "c", 1e-9, 3),
          failed("p3", "a"),
          make_record("p3", "b", 1e-9, 8),
          make_record("p3", "c", 1e-9, 1),
          failed("p4", "a"),
          failed("p4", "b"),
          failed("p4", "c")};
}

TEST(PerformanceProfile, MatchesTheHandComputedExample) {
  const auto records = example();
  const TimeTable table = make_time_table(records, 1e-8);
  ASSERT_THAT(table.solvers, testing::ElementsAre("a", "b", "c"));
  ASSERT_EQ(table.rows.size(), 4u);
  const auto profiles = performance_profiles(table);

  ASSERT_EQ(profiles[0].size(), 1u);  // a: ratio 1 on p1 and p2
  EXPECT_DOUBLE_EQ(profiles[0][0].ratio, 1.0);
  EXPECT_DOUBLE_EQ(profiles[0][0].share, 0.5);

  ASSERT_EQ(profiles[1].size(), 2u);  // b: ratio 2 on p1, 8 on p3
  EXPECT_DOUBLE_EQ(profiles[1][0].ratio, 2.0);
  EXPECT_DOUBLE_EQ(profiles[1][0].share, 0.25);
  EXPECT_DOUBLE_EQ(profiles[1][1].ratio, 8.0);
  EXPECT_DOUBLE_EQ(profiles[1][1].share, 0.5);

  ASSERT_EQ(profiles[2].size(), 2u);  // c: ratio 1 on p2 and p3, 4 on p1; p4 counts against it
  EXPECT_DOUBLE_EQ(profiles[2][0].share, 0.5);
  EXPECT_DOUBLE_EQ(profiles[2][1].ratio, 4.0);
  EXPECT_DOUBLE_EQ(profiles[2][1].share, 0.75);
}

TEST(PerformanceProfile, AreaIsTheMeanHeightOverTheLog2Axis) {
  const auto profiles = performance_profiles(make_time_table(example(), 1e-8));
  EXPECT_DOUBLE_EQ(profile_area(profiles[0]), 0.5);
  EXPECT_DOUBLE_EQ(profile_area(profiles[1]), (0.25 * 9 + 0.25 * 7) / 10);
  EXPECT_DOUBLE_EQ(profile_area(profiles[2]), (0.5 * 10 + 0.25 * 8) / 10);
  EXPECT_DOUBLE_EQ(profile_area({}), 0.0);
}

TEST(Ranking, CountsFailuresAndAveragesOnlyWhatAllSolve) {
  const auto ranking = rank(make_time_table(example(), 1e-8));
  ASSERT_EQ(ranking.size(), 3u);
  EXPECT_EQ(ranking[0].solver, "c");  // 3 solved
  EXPECT_EQ(ranking[1].solver, "a");  // 2 solved, area 0.5
  EXPECT_EQ(ranking[2].solver, "b");  // 2 solved, area 0.4
  EXPECT_EQ(ranking[0].solved, 3);
  EXPECT_EQ(ranking[0].problems, 4);
  EXPECT_EQ(ranking[0].fastest, 2);
  EXPECT_EQ(ranking[0].common, 1);  // p1
  EXPECT_NEAR(*ranking[0].common_mean_s, 4.0, 1e-12);
  EXPECT_NEAR(*ranking[2].common_mean_s, 2.0, 1e-12);
}

TEST(Ranking, ASolverWithoutASuccessHasNoMeanAndDoesNotEmptyTheCommonSet) {
  const std::vector<Record> records = {make_record("p1", "a", 1e-9, 1), failed("p1", "dead")};
  const auto ranking = rank(make_time_table(records, 1e-8));
  EXPECT_EQ(ranking[0].common, 1);
  EXPECT_EQ(ranking[1].solver, "dead");
  EXPECT_FALSE(ranking[1].common_mean_s.has_value());
}

TEST(ShiftedGeometricMean, IsTheGeometricMeanOfShiftedTimes) {
  const std::vector<double> times = {0.0, 3e-3};
  EXPECT_NEAR(*shifted_geometric_mean(times), 1e-3, 1e-15);  // sqrt(1 ms 4 ms) - 1 ms
  EXPECT_FALSE(shifted_geometric_mean({}).has_value());
}

TEST(TimeToTolerance, IsTheFirstCurvePointThatMeetsIt) {
  Record record = make_record("p", "a", 1e-9, 5.0);
  record.curve = {{0.0, 0, 1.0}, {1.0, 10, 1e-5}, {2.0, 20, 1e-3}, {4.0, 40, 1e-9}};
  EXPECT_DOUBLE_EQ(time_to_tolerance(record, 1e-4), 1.0);
  EXPECT_DOUBLE_EQ(time_to_tolerance(record, 1e-6), 4.0);
  EXPECT_DOUBLE_EQ(time_to_tolerance(record, 1e-8), 4.0);
}

TEST(TimeToTolerance, IsInfiniteUnlessTheReturnedAnswerWasVerified) {
  Record record = make_record("p", "a", 1e-5, 5.0);
  record.curve = {{1.0, 10, 1e-9}};  // what it showed on the way is not what it returned
  EXPECT_EQ(time_to_tolerance(record, 1e-8), kNever);
  EXPECT_DOUBLE_EQ(time_to_tolerance(record, 1e-4), 1.0);
  record.eta = std::nan("");
  EXPECT_EQ(time_to_tolerance(record, 1e-4), kNever);
}

TEST(TimeToTolerance, WithoutACurveIsTheWholeSolveAndNeverBeyondTheLimit) {
  Record record = make_record("p", "a", 1e-9, 5.0);
  record.setup_s = 1.0;
  EXPECT_DOUBLE_EQ(time_to_tolerance(record, 1e-8), 6.0);
  record.settings.time_limit_s = 5.5;
  EXPECT_EQ(time_to_tolerance(record, 1e-8), kNever);
}

TEST(TimeTable, RepetitionsCountWithTheirMedianInWhichAFailureIsInfinite) {
  std::vector<Record> records = {make_record("p", "a", 1e-9, 1), make_record("p", "a", 1e-9, 3),
                                 failed("p", "a")};
  EXPECT_DOUBLE_EQ(make_time_table(records, 1e-8).rows[0].time_s[0], 3.0);
  records.push_back(failed("p", "a"));
  EXPECT_EQ(make_time_table(records, 1e-8).rows[0].time_s[0], kNever);
}

}  // namespace
}  // namespace conebench::results
