#include "results/rank_stability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "random_records.h"

namespace conebench::results {
namespace {

std::vector<std::string> order(const TimeTable& table) {
  std::vector<std::string> names;
  for (const Rank& line : rank(table)) names.push_back(line.solver);
  return names;
}

Record timed(const std::string& problem, const std::string& solver, double time_s) {
  Record record = make_record(problem, solver, 1e-9, time_s);
  record.problem.family = "dem/" + problem;
  record.settings.time_limit_s = 1e6;
  return record;
}

// Times [s]; all solve everything. The axis of the performance profile ends at a ratio of 2^10.
//            a    b    d
//   p1       1    4    4
//   p2..p4   2    1    2^-10
std::vector<Record> flip_example() {
  std::vector<Record> records;
  const double tiny = std::exp2(-10);
  for (const char* problem : {"p2", "p3", "p4"}) {
    records.push_back(timed(problem, "a", 2.0));
    records.push_back(timed(problem, "b", 1.0));
    records.push_back(timed(problem, "d", tiny));
  }
  records.push_back(timed("p1", "a", 1.0));
  records.push_back(timed("p1", "b", 4.0));
  records.push_back(timed("p1", "d", 4.0));
  return records;
}

// Without d: a loses 1 octave on each of p2 to p4, b 2 on p1: b before a. With d both are at the
// end of the axis on p2 to p4, and a is ahead by p1 (Gould and Scott, 2016).
TEST(RankStability, TheOrderOfTwoMayHangOnAThird) {
  const TimeTable table = make_time_table(flip_example(), 1e-8);
  EXPECT_THAT(order(table), testing::ElementsAre("d", "a", "b"));
  EXPECT_THAT(order(without_solver(table, 2)), testing::ElementsAre("b", "a"));

  const Stability found = rank_stability(table);
  EXPECT_THAT(found.solver_flips, testing::ElementsAre(Flip{"d", "a", "b"}));
  ASSERT_EQ(found.places.size(), 3u);
  EXPECT_EQ(found.places[1].solver, "a");
  EXPECT_EQ(found.places[1].place, 2);
  EXPECT_EQ(found.places[1].best_by_solver, 2);
  EXPECT_EQ(found.places[1].worst_by_solver, 3);
  EXPECT_EQ(found.places[2].best_by_solver, 2);
}

TEST(RankStability, TheOrderOfTwoMayHangOnOneScene) {
  auto records = flip_example();
  std::erase_if(records, [](const Record& r) { return r.solver == "d" || r.problem.name > "p2"; });
  // p1: a ahead by 2 octaves; p2: b ahead by 1.
  const Stability found = rank_stability(make_time_table(records, 1e-8));
  EXPECT_THAT(found.scene_flips, testing::ElementsAre(Flip{"dem/p1", "a", "b"}));
  EXPECT_EQ(found.places[0].worst_by_scene, 2);
}

TEST(RankStability, ASolverThatIsFasterEverywhereIsFirstWhateverIsLeftOut) {
  std::vector<Record> records;
  for (int i = 0; i < 6; ++i) {
    for (const auto& [solver, time_s] : {std::pair("a", 1.0), {"b", 2.0}, {"c", 4.0}}) {
      records.push_back(timed("p" + std::to_string(i), solver, time_s));
    }
  }
  const Stability found = rank_stability(make_time_table(records, 1e-8));
  EXPECT_TRUE(found.scene_flips.empty());
  EXPECT_TRUE(found.solver_flips.empty());
  for (const PlaceRange& range : found.places) {
    EXPECT_EQ(range.best_by_scene, range.place);
    EXPECT_EQ(range.worst_by_scene, range.place);
    EXPECT_EQ(range.best_by_solver, range.place);
    EXPECT_EQ(range.worst_by_solver, range.place);
  }
}

TEST(RankStability, ASingleSceneIsNotLeftOut) {
  const std::vector<Record> records = {timed("p1", "a", 1.0), timed("p1", "b", 2.0)};
  EXPECT_TRUE(rank_stability(make_time_table(records, 1e-8)).scene_flips.empty());
}

}  // namespace
}  // namespace conebench::results
