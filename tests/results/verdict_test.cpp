#include "results/verdict.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "make_record.h"
#include "results/warm_gain.h"

namespace conebench::results {
namespace {

using testing::HasSubstr;
using testing::Not;

// Ten scenes of one problem; a solver solves the first `solved` of them in `time_s`.
void add_solver(Group& group, const std::string& name, int solved, double time_s) {
  for (int p = 0; p < 10; ++p) {
    Record record = make_record("p" + std::to_string(p), name, p < solved ? 1e-9 : 1e-2, time_s);
    record.problem.family = "dem/scene-" + std::to_string(p);
    group.methods.push_back(record);
  }
  group.settings = group.methods.front().settings;
}

Verdict verdict_of(const Group& group) { return verdict(GroupNumbers(group)); }

TEST(Verdict, NamesOneThatIsBetterThanAll) {
  Group group;
  add_solver(group, "good", 10, 0.01);
  add_solver(group, "bad", 2, 0.01);
  EXPECT_THAT(verdict_of(group).sentence, HasSubstr("**Use `good`:** it brought 10 of 10"));
}

TEST(Verdict, NamesTheRivalsThatChanceMayExplain) {
  Group group;
  add_solver(group, "one", 8, 0.01);
  add_solver(group, "two", 8, 0.0101);
  const Verdict v = verdict_of(group);
  EXPECT_THAT(v.sentence, HasSubstr("not beyond doubt"));
  EXPECT_THAT(v.sentence, HasSubstr("better than `two`"));
}

TEST(Verdict, ClaimsNoLeadOverOneThatSolvesAsManyAndIsFaster) {
  Group group;
  add_solver(group, "exact", 10, 1.0);
  add_solver(group, "swift", 10, 0.001);
  group.methods.front().eta = 1e-9;
  group.methods.back().eta = 1e-2;  // swift fails once: exact leads, but is a thousand times slower
  const Verdict v = verdict_of(group);
  EXPECT_THAT(v.sentence, HasSubstr("`exact` leads, not beyond doubt"));
  EXPECT_THAT(v.sentence, HasSubstr("better than `swift`"));
}

TEST(Verdict, SaysWhenNothingWorksAndWhenNothingIsCompared) {
  Group failing;
  add_solver(failing, "a", 0, 1.0);
  add_solver(failing, "b", 0, 1.0);
  EXPECT_THAT(verdict_of(failing).sentence, HasSubstr("no solver brought any of 10 problems"));
  Group alone;
  add_solver(alone, "a", 5, 1.0);
  EXPECT_THAT(verdict_of(alone).sentence, HasSubstr("Nothing else was run"));
  Group apart;
  apart.methods = {make_record("p1", "a", 1e-9, 1), make_record("p2", "b", 1e-9, 1)};
  apart.settings = apart.methods.front().settings;
  EXPECT_THAT(verdict_of(apart).sentence, HasSubstr("No comparison"));
}

TEST(Verdict, CountsWhatTheBestOfAllWouldSolveAndNeverBoundsAnError) {
  Group group;
  add_solver(group, "a", 6, 0.01);
  add_solver(group, "b", 4, 0.02);
  const Verdict v = verdict_of(group);
  EXPECT_THAT(v.facts, testing::Contains(HasSubstr("would solve 6 of 10; 2 of them one solver")));
  EXPECT_THAT(v.facts, testing::Contains(HasSubstr("fails on 4 of 10")));
  EXPECT_THAT(v.limits, testing::Contains(HasSubstr("no error bound")));
  EXPECT_THAT(v.limits, testing::Contains(HasSubstr("10 scenes")));
}

TEST(WarmGain, IsColdOverWarmTimeWithoutTheFirstStep) {
  Group cold, warm;
  add_solver(cold, "a", 10, 0.4);
  add_solver(warm, "a", 10, 0.1);
  for (std::size_t i = 0; i < warm.methods.size(); ++i) {
    Record& record = warm.methods[i];
    record.settings.mode = "sequence";
    record.sequence = {.name = "s", .id = "s", .index = static_cast<int>(i), .length = 10};
  }
  warm.settings = warm.methods.front().settings;
  const std::vector<Group> groups = {cold, warm};
  ASSERT_EQ(cold_twin(groups[1], groups), &groups[0]);
  EXPECT_EQ(cold_twin(groups[0], groups), nullptr);
  const auto gains = warm_gains(cold, warm);
  ASSERT_EQ(gains.size(), 1u);
  EXPECT_EQ(gains[0].both, 9);
  EXPECT_NEAR(gains[0].gain.value(), 4.0, 1e-12);
  EXPECT_NEAR(gains[0].interval.value().low, 4.0, 1e-9);
}

}  // namespace
}  // namespace conebench::results
