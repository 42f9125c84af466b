#include "results/compare.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "problems/error.h"
#include "random_records.h"

namespace conebench::results {
namespace {

// Ten scenes of one problem each, solver "a", 0.5 s and 100 iterations each.
std::vector<Record> ten_scenes() {
  std::vector<Record> records;
  for (int i = 0; i < 10; ++i) {
    records.push_back(make_record("p" + std::to_string(i), "a", 1e-9, 0.5));
    records.back().problem.family = "dem/p" + std::to_string(i);
    records.back().iterations = 100;
  }
  return records;
}

TEST(Compare, OfASetWithItselfIsOneEverywhere) {
  const Comparison found = compare(ten_scenes(), ten_scenes());
  EXPECT_EQ(found.pairs, 10u);
  EXPECT_EQ(found.scenes, 10u);
  ASSERT_EQ(found.quantities.size(), quantity_names().size());
  for (std::size_t i = 0; i < found.quantities.size(); ++i) {
    const Quantity& q = found.quantities[i];
    EXPECT_EQ(q.name, quantity_names()[i]);
    const bool count = q.name == "failures" || q.name == "missing";
    EXPECT_DOUBLE_EQ(*q.value, count ? 0.0 : 1.0) << q.name;
    if (q.interval) {
      EXPECT_DOUBLE_EQ(q.interval->low, *q.value) << q.name;
      EXPECT_DOUBLE_EQ(q.interval->high, *q.value) << q.name;
    }
  }
}

TEST(Compare, KnownRatios) {
  auto fresh = ten_scenes();
  for (Record& record : fresh) {
    record.solve_s = 1.0;
    record.iterations = 50;
    record.eta = 1e-8;
  }
  const Comparison found = compare(ten_scenes(), fresh);
  EXPECT_NEAR(*found.quantity("sgm(time)").value, 2.0, 1e-12);
  EXPECT_NEAR(*found.quantity("sgm(time)").base, 0.5, 1e-12);
  EXPECT_NEAR(*found.quantity("p50(time)").value, 2.0, 1e-12);
  EXPECT_NEAR(*found.quantity("iterations").value, 0.5, 1e-12);
  EXPECT_NEAR(*found.quantity("gm(eta)").value, 10.0, 1e-9);
  EXPECT_NEAR(*found.quantity("solved").value, 1.0, 1e-12);
}

TEST(Compare, AnIntervalHoldsTheSpreadOverScenes) {
  auto fresh = ten_scenes();
  for (std::size_t i = 0; i < fresh.size(); ++i) fresh[i].iterations = i % 2 == 0 ? 50 : 200;
  const Quantity found = compare(ten_scenes(), fresh).quantity("iterations");
  EXPECT_NEAR(*found.value, 1.0, 1e-12);
  EXPECT_LT(found.interval->low, 0.8);
  EXPECT_GT(found.interval->high, 1.25);
}

TEST(Compare, ANewFailureIsCountedNamedAndNeverATime) {
  auto fresh = ten_scenes();
  fresh[3].status = Status::kKilledTime;
  fresh[3].eta = Record::kUnknown;
  fresh[3].solve_s = 0.0;
  const Comparison found = compare(ten_scenes(), fresh);
  EXPECT_EQ(*found.quantity("failures").value, 1.0);
  EXPECT_THAT(found.new_failures, testing::ElementsAre("a on p3, repetition 0"));
  EXPECT_DOUBLE_EQ(*found.quantity("sgm(time)").value, 1.0);  // over the nine that both solve
  EXPECT_TRUE(std::isinf(*found.quantity("max(time)").value));
  EXPECT_DOUBLE_EQ(*found.quantity("p50(time)").value, 1.0);
  EXPECT_DOUBLE_EQ(*found.quantity("solved").value, 0.9);
}

TEST(Compare, AFailureOnBothSidesLeavesTheTailUndefined) {
  auto base = ten_scenes();
  base[3].eta = Record::kUnknown;
  const Comparison found = compare(base, base);
  EXPECT_FALSE(found.quantity("max(time)").value.has_value());
  EXPECT_EQ(*found.quantity("failures").value, 0.0);
}

TEST(Compare, AFastWrongAnswerIsAFailureNotAGain) {
  auto fresh = ten_scenes();
  for (Record& record : fresh) {
    record.solve_s = 1e-6;
    record.eta = 0.5;
    record.claimed = "converged";
    record.status = Status::kRefuted;
  }
  const Comparison found = compare(ten_scenes(), fresh);
  EXPECT_EQ(*found.quantity("failures").value, 10.0);
  EXPECT_FALSE(found.quantity("sgm(time)").value.has_value());
  EXPECT_TRUE(std::isinf(*found.quantity("p50(time)").value));
}

TEST(Compare, UnpairedRowsAreCountedAndNamed) {
  auto base = ten_scenes(), fresh = ten_scenes();
  base.pop_back();
  fresh.erase(fresh.begin());
  fresh.push_back(make_record("p1", "b", 1e-9, 1));
  const Comparison found = compare(base, fresh);
  EXPECT_EQ(found.pairs, 8u);
  EXPECT_THAT(found.only_base, testing::ElementsAre("a on p0, repetition 0"));
  EXPECT_THAT(found.only_fresh,
              testing::ElementsAre("a on p9, repetition 0", "b on p1, repetition 0"));
  EXPECT_EQ(*found.quantity("missing").value, 1.0);
}

TEST(Compare, RowsPairOnlyUnderTheSameRules) {
  auto fresh = ten_scenes();
  fresh[0].settings.tol = 1e-4;
  fresh[1].settings.mode = "warm";
  fresh[2].repetition = 1;
  fresh[3].problem.content_sha256 = "other content";
  fresh[4].donor = "ipm";
  fresh[5].solver_build = "another build";  // what is compared
  fresh[6].host.cpu = "another processor";
  const Comparison found = compare(ten_scenes(), fresh);
  EXPECT_EQ(found.pairs, 5u);
  EXPECT_TRUE(found.other_host);
}

TEST(Compare, OfSeveralRowsOfATaskTheLastStartedCounts) {
  auto base = ten_scenes();
  Record later = base[0];
  later.iterations = 400;
  later.started_at = "2025-01-01T00:00:00Z";
  base.insert(base.begin(), later);
  const Comparison found = compare(base, ten_scenes());
  EXPECT_EQ(found.superseded, 1u);
  EXPECT_EQ(found.pairs, 10u);
  EXPECT_NEAR(*found.quantity("iterations").value, std::pow(0.25, 0.1), 1e-12);
}

TEST(Compare, RefusesSetsWithoutACommonTask) {
  EXPECT_THROW(compare(ten_scenes(), {}), problems::InputError);
  EXPECT_THROW(compare({}, {}), problems::InputError);
}

// Two repetitions that differ by `spread`, times `factor`.
std::vector<Record> repeated(double spread, double factor) {
  std::vector<Record> records;
  for (Record record : ten_scenes()) {
    record.solve_s *= factor;
    records.push_back(record);
    record.repetition = 1;
    record.solve_s *= spread;
    records.push_back(record);
  }
  return records;
}

TEST(Compare, InsideTheNoiseFloorNoDifferenceIsMeasurable) {
  const Comparison found = compare(repeated(2.0, 1.0), repeated(2.0, 1.04));
  EXPECT_GT(*found.noise, 1.04);
  EXPECT_TRUE(found.no_difference_measurable());
  EXPECT_NEAR(*found.quantity("sgm(time)").value, 1.04, 1e-3);
  EXPECT_EQ(found.gate_values().at("sgm(time)"), 1.0);
}

TEST(Compare, OutsideTheNoiseFloorTheDifferenceStands) {
  const Comparison found = compare(repeated(1.01, 1.0), repeated(1.01, 1.5));
  EXPECT_LT(*found.noise, 1.02);
  EXPECT_FALSE(found.no_difference_measurable());
  EXPECT_NEAR(*found.gate_values().at("sgm(time)"), 1.5, 1e-3);
  const Comparison single = compare(ten_scenes(), ten_scenes());
  EXPECT_FALSE(single.noise.has_value());
  EXPECT_FALSE(single.no_difference_measurable());
}

TEST(Compare, TheOrderOfTheRowsDoesNotMatter) {
  const auto base = random_records(1), fresh = random_records(2);
  const Comparison found = compare(base, fresh);
  const Comparison other = compare(shuffled(base, 5), shuffled(fresh, 6));
  for (const std::string& name : quantity_names()) {
    EXPECT_EQ(found.quantity(name).value, other.quantity(name).value) << name;
  }
  EXPECT_EQ(found.noise, other.noise);
  EXPECT_EQ(found.new_failures, other.new_failures);
}

}  // namespace
}  // namespace conebench::results
