// What a ranking must not do, whatever the records are. That partial results are kept and that one
// hung solver does not stop a run is tested where campaigns run: tests/harness/campaign_test.cpp.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "random_records.h"
#include "results/profiles.h"
#include "results/report.h"

namespace conebench::results {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();
constexpr std::uint32_t kSeeds = 30;

Rank rank_of(const std::vector<Record>& records, const std::string& solver, double tol = 1e-8) {
  const auto ranking = rank(make_time_table(records, tol));
  return *std::find_if(ranking.begin(), ranking.end(),
                       [&](const Rank& line) { return line.solver == solver; });
}

TEST(Fairness, AFastWrongAnswerIsNotRewarded) {
  std::vector<Record> records = {make_record("p1", "honest", 1e-9, 5.0),
                                 make_record("p1", "liar", 0.3, 1e-6)};
  records[1].claimed = "converged";
  records[1].status = Status::kRefuted;
  records[1].curve = {{1e-7, 1, 1e-12}};  // nor what it showed on the way
  const auto ranking = rank(make_time_table(records, 1e-8));
  EXPECT_EQ(ranking[0].solver, "honest");
  EXPECT_EQ(ranking[0].fastest, 1);
  EXPECT_EQ(ranking[1].solved, 0);
  EXPECT_EQ(ranking[1].area, 0.0);
}

TEST(Fairness, AFailureIsNeverTheTimeLimit) {
  std::vector<Record> records;
  for (int i = 0; i < 4; ++i) {
    records.push_back(make_record("p" + std::to_string(i), "a", 1e-9, 1.0));
  }
  const double mean_s = *rank_of(records, "a").common_mean_s;
  records.push_back(make_record("p4", "a", 1e-3, 10.0));
  records.back().status = Status::kTimeLimit;
  EXPECT_DOUBLE_EQ(*rank_of(records, "a").common_mean_s, mean_s);
  EXPECT_EQ(make_time_table(records, 1e-8).rows.back().time_s[0], kNever);
  EXPECT_THAT(markdown_report({.records = records}), testing::HasSubstr("— time_limit"));
}

TEST(Fairness, AFailingRowNeverImprovesASolver) {
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    auto records = random_records(seed);
    const Rank before = rank_of(records, "a");
    Record failed = make_record("one-more", "a", Record::kUnknown, 0.0);
    failed.status = Status::kCrashed;
    records.push_back(failed);
    for (const char* other : {"b", "c", "d"}) {
      records.push_back(make_record("one-more", other, 1e-9, 1.0));
    }
    const Rank after = rank_of(records, "a");
    EXPECT_EQ(after.solved, before.solved) << seed;
    EXPECT_EQ(after.problems, before.problems + 1) << seed;
    EXPECT_LE(after.area, before.area) << seed;
    EXPECT_LE(after.fastest, before.fastest) << seed;
  }
}

TEST(Fairness, ARepetitionThatFailsNeverMakesATaskFaster) {
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    auto records = random_records(seed, {.repetitions = 3});
    const TimeTable before = make_time_table(records, 1e-8);
    Record failed = records.front();
    failed.repetition = 3;
    failed.eta = Record::kUnknown;
    records.push_back(failed);
    const TimeTable after = make_time_table(records, 1e-8);
    for (std::size_t i = 0; i < after.rows.size(); ++i) {
      for (std::size_t s = 0; s < after.solvers.size(); ++s) {
        EXPECT_GE(after.rows[i].time_s[s], before.rows[i].time_s[s]) << seed;
      }
    }
  }
}

TEST(Fairness, ATighterToleranceNeverMakesATimeFiniteOrShorter) {
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    for (const Record& record : random_records(seed)) {
      double before = 0.0;
      for (const double tol : {1e-1, 1e-2, 1e-4, 1e-8, 1e-12}) {
        const double time_s = time_to_tolerance(record, tol);
        EXPECT_GE(time_s, before) << seed;
        before = time_s;
      }
    }
  }
}

TEST(Fairness, TheOrderOfTheRowsDoesNotMatter) {
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    const auto records = random_records(seed, {.not_run_share = 0.05});
    const auto found = rank(make_time_table(records, 1e-8));
    const auto other = rank(make_time_table(shuffled(records, seed + 1), 1e-8));
    ASSERT_EQ(found.size(), other.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].solver, other[i].solver);
      EXPECT_EQ(found[i].area, other[i].area);
      EXPECT_EQ(found[i].common_mean_s, other[i].common_mean_s);
      EXPECT_EQ(found[i].not_run, other[i].not_run);
    }
  }
}

// a: 3 of 3 run; b was not run on p3, which it might have failed or won.
TEST(Fairness, WhatWasNotRunIsNeitherAFailureNorASuccess) {
  const std::vector<Record> records = {
      make_record("p1", "a", 1e-9, 1), make_record("p2", "a", 1e-9, 4),
      make_record("p3", "a", 1e-9, 1), make_record("p1", "b", 1e-9, 2),
      make_record("p2", "b", 1e-9, 2)};
  const Rank a = rank_of(records, "a"), b = rank_of(records, "b");
  EXPECT_EQ(a.problems, 2);
  EXPECT_EQ(b.problems, 2);
  EXPECT_EQ(a.solved, 2);
  EXPECT_EQ(b.solved, 2);
  EXPECT_EQ(a.not_run, 0);
  EXPECT_EQ(b.not_run, 1);
  EXPECT_DOUBLE_EQ(a.area, b.area);  // each is twice as fast once
  EXPECT_THAT(ranking_table(records, 1e-8), testing::HasSubstr("not run"));
  EXPECT_THAT(markdown_report({.records = records}), testing::HasSubstr("| not run |"));
}

TEST(Fairness, WhatOneSolverSkipsIsLeftOutForAll) {
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    auto records = random_records(seed, {.repetitions = 1});
    const TimeTable table = make_time_table(records, 1e-8);
    std::erase_if(records, [&](const Record& r) { return r.solver == "a" && !r.solved(); });
    // On what is left all times are as before.
    const TimeTable rest = comparable(make_time_table(records, 1e-8));
    for (const auto& row : rest.rows) {
      const auto found = std::find_if(table.rows.begin(), table.rows.end(), [&](const auto& old) {
        return old.problem.content_sha256 == row.problem.content_sha256;
      });
      EXPECT_EQ(found->time_s, row.time_s) << seed;
    }
    EXPECT_EQ(rank_of(records, "b").problems, rank_of(records, "a").problems) << seed;
  }
}

TEST(Fairness, ASequenceWithAnotherDonorIsAContenderOfItsOwn) {
  std::vector<Record> records = {make_record("p1", "gs", 1e-9, 1),
                                 make_record("p1", "gs", 1e-9, 4)};
  records[1].donor = "ipm";
  const TimeTable table = make_time_table(records, 1e-8);
  EXPECT_THAT(table.solvers, testing::ElementsAre("gs", "gs after ipm"));
  EXPECT_THAT(table.rows[0].time_s, testing::ElementsAre(1.0, 4.0));
}

TEST(Fairness, TwoBuildsOfASolverAreNoRepetitionsOfOne) {
  std::vector<Record> records = {make_record("p1", "gs", 1e-9, 1), make_record("p1", "gs", 1e-9, 4),
                                 make_record("p1", "spg", 1e-9, 2)};
  records[0].solver_build = "0123456789ab";
  records[1].solver_build = "ba9876543210";
  const auto groups = group_by_settings(records);
  const TimeTable table = make_time_table(groups[0].methods, 1e-8);
  EXPECT_THAT(table.solvers, testing::ElementsAre("gs@01234567", "gs@ba987654", "spg"));
  EXPECT_THAT(table.rows[0].time_s, testing::ElementsAre(1.0, 4.0, 2.0));
}

// A shard that was requeued on a slower kind of machine after two of its three tasks.
TEST(Fairness, TimesOfTwoKindsOfMachinesAreNeverMixed) {
  std::vector<Record> records = {make_record("p1", "a", 1e-9, 1), make_record("p1", "b", 1e-9, 2),
                                 make_record("p1", "a", 1e-9, 3), make_record("p1", "b", 1e-9, 4),
                                 make_record("p1", "c", 1e-9, 5)};
  for (std::size_t i = 2; i < 5; ++i) {
    records[i].host.cpu = "a slow one";
    records[i].solver_build = "for the slow one";
  }
  const auto groups = group_by_settings(records);
  ASSERT_EQ(groups.size(), 1u);
  const TimeTable table = make_time_table(groups[0].methods, 1e-8);
  EXPECT_THAT(table.solvers, testing::ElementsAre("a", "b", "c"));
  EXPECT_THAT(table.rows[0].time_s, testing::ElementsAre(3.0, 4.0, 5.0));
  EXPECT_THAT(markdown_report({.records = records}),
              testing::HasSubstr("2 rows are in no ranking"));
}

TEST(Fairness, OfTwoMachinesThatDidAsMuchTheLaterCountsWhateverTheOrder) {
  std::vector<Record> records = {make_record("p1", "a", 1e-9, 1), make_record("p1", "a", 1e-9, 9),
                                 make_record("p2", "a", 1e-9, 5)};
  records[1].host.cores = 64;
  records[1].started_at = "2024-05-02T12:00:00Z";
  for (int turn = 0; turn < 2; ++turn, std::swap(records[0], records[1])) {
    const TimeTable table = make_time_table(group_by_settings(records)[0].methods, 1e-8);
    ASSERT_EQ(table.rows.size(), 2u);
    EXPECT_EQ(table.rows[0].time_s[0], 9.0);
    EXPECT_EQ(table.rows[1].time_s[0], 5.0);  // another problem may have run elsewhere
  }
}

// Without a curve only the time of the whole run is known, which is no time to a looser tolerance.
TEST(Fairness, ASolverThatStopsByItsOwnTestIsRankedAtItsOwnToleranceOnly) {
  std::vector<Record> records = {make_record("p1", "a", 1e-9, 1), make_record("p1", "b", 1e-9, 2)};
  EXPECT_EQ(group_by_settings(records)[0].tolerances().size(), 3u);
  for (Record& record : records) record.settings.stop = "own";
  EXPECT_THAT(group_by_settings(records)[0].tolerances(), testing::ElementsAre(1e-8));
  EXPECT_THAT(csv_report(records), testing::HasSubstr(",,,1,"));  // time_to_1e-4_s, time_to_1e-6_s
}

TEST(Fairness, AnUpperBoundIsCalledOne) {
  std::vector<Record> records = {make_record("p1", "a", 1e-9, 1),
                                 make_record("p1", "exec:b", 1e-9, 2)};
  records[0].curve = {{0.5, 1, 1e-5}, {1.0, 2, 1e-9}};
  EXPECT_THAT(ranking_remark(records, 1e-4), testing::HasSubstr("Of `exec:b` only the time to"));
  EXPECT_THAT(ranking_remark(records, 1e-4), testing::Not(testing::HasSubstr("`a`")));
  EXPECT_EQ(ranking_remark(records, 1e-8), "");
}

TEST(Fairness, WhoSolvesNothingHasNoPlace) {
  const std::vector<Record> records = {make_record("p1", "a", 1e-9, 1),
                                       make_record("p1", "liar", 0.3, 1e-6)};
  EXPECT_EQ(ranking_remark(records, 1e-8), "Solved nothing, so without a place: `liar`. ");
}

TEST(Report, NamesWhatSpeaksAgainstTheTimes) {
  const auto records = random_records(1);
  const std::string text =
      markdown_report({.records = records, .machine_marks = {"campaign: time of arithmetic"}});
  EXPECT_THAT(text, testing::HasSubstr("**times in doubt:** campaign: time of arithmetic"));
}

TEST(Report, SaysHowFarToTrustTheRanking) {
  const auto records = random_records(1);
  const std::string text = markdown_report({.records = records});
  for (const char* heading :
       {"## How far to trust it", "### Tails", "### Which solvers are told apart",
        "### Solved against tolerance", "### Deadlines", "### Rank stability",
        "not told apart from", "p99.9"}) {
    EXPECT_THAT(text, testing::HasSubstr(heading));
  }
}

TEST(Report, HoldsWhenNoProblemWasRunByAll) {
  const std::vector<Record> records = {make_record("p1", "a", 1e-9, 1),
                                       make_record("p2", "b", 1e-9, 1)};
  EXPECT_THAT(markdown_report({.records = records}), testing::HasSubstr("0/0"));
}

}  // namespace
}  // namespace conebench::results
