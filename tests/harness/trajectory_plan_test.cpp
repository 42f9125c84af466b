// Which runs a wish comes to, whether seeds differ, and rows that survive.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>

#include "harness/trajectories.h"
#include "problems/error.h"
#include "tests/engine/own_folder.h"

namespace conebench::harness {
namespace {

using testing::ElementsAre;

TrajectoryWish small_column() {
  TrajectoryWish wish{.scene = "sand-column"};
  wish.overrides = {"grid.cells=[16,4]", "grid.size_m=[4,1]", "blocks[0].jitter=0.5"};
  wish.solvers = {"gs"};
  wish.tolerances = {1e-2, 1e-1};
  wish.seeds = "2";
  wish.reference_tol = 1e-6;
  wish.steps = 3;
  return wish;
}

TEST(TrajectoryPlan, IsEverySolverAtEveryToleranceForEverySeedBesideTheReference) {
  TrajectoryWish wish = small_column();
  wish.solvers = {"gs[omega=0.8,1]", "gs"};  // gs[omega=1] is gs
  const TrajectoryPlan plan = plan_trajectories(wish);
  EXPECT_THAT(plan.solvers, ElementsAre("gs[omega=0.8]", "gs"));
  EXPECT_THAT(plan.tolerances, ElementsAre(1e-1, 1e-2));
  EXPECT_THAT(plan.seeds, ElementsAre(1, 2));
  EXPECT_EQ(plan.tasks.size(), 2u * (1 + 2 * 2));
  std::set<std::string> keys;
  for (const TrajectoryTask& task : plan.tasks) keys.insert(task.key);
  EXPECT_EQ(keys.size(), plan.tasks.size());
  EXPECT_TRUE(plan.tasks.front().reference);
}

TEST(TrajectoryPlan, TheSceneChoosesTheSolverAndTheFirstSeed) {
  TrajectoryWish wish = small_column();
  wish.solvers.clear();
  wish.overrides.insert(wish.overrides.end(), {"seed=7", "solver.name=gs"});
  const TrajectoryPlan plan = plan_trajectories(wish);
  EXPECT_THAT(plan.solvers, ElementsAre("gs"));
  EXPECT_THAT(plan.seeds, ElementsAre(7, 8));
  wish.seeds = "5,3,9";
  EXPECT_THAT(plan_trajectories(wish).seeds, ElementsAre(5, 3, 9));
}

TEST(TrajectoryPlan, KeysChangeWithAllThatARunDependsOn) {
  const auto key_of = [](const TrajectoryWish& wish) {
    return plan_trajectories(wish).tasks.back().key;
  };
  const std::string key = key_of(small_column());
  EXPECT_EQ(key_of(small_column()), key);
  TrajectoryWish longer = small_column(), heavier = small_column();
  longer.steps = 4;
  heavier.overrides.push_back("material.density_kg_m3=1600");
  EXPECT_NE(key_of(longer), key);
  EXPECT_NE(key_of(heavier), key);
}

TEST(TrajectoryPlan, ASceneWithoutChanceIsRunOnce) {
  TrajectoryWish wish = small_column();
  wish.overrides.pop_back();  // particles undisturbed
  const TrajectoryPlan plan = plan_trajectories(wish);
  EXPECT_FALSE(plan.seed_matters);
  EXPECT_THAT(plan.seeds, ElementsAre(1));
  EXPECT_EQ(plan.tasks.size(), 3u);
}

TEST(TrajectoryPlan, WhatCannotBeRunIsAnInputError) {
  const auto refused = [](auto change) {
    TrajectoryWish wish = small_column();
    change(wish);
    EXPECT_THROW(plan_trajectories(wish), problems::InputError);
  };
  refused([](auto& w) { w.seeds = "0"; });
  refused([](auto& w) { w.seeds = "two"; });
  refused([](auto& w) { w.seeds = "1,2,1"; });
  refused([](auto& w) { w.seeds = "1,,2"; });
  refused([](auto& w) { w.tolerances = {1e-2, 1e-7}; });
  refused([](auto& w) { w.tolerances.clear(); });
  refused([](auto& w) { w.solvers = {"gss"}; });
  refused([](auto& w) { w.reference = "gs[omega=0.8,1]"; });
  refused([](auto& w) { w.scene = "sand-colum"; });
}

// What a seed does in each scene of the program. Those without chance have single bodies, lattices,
// masonry or undisturbed sand.
TEST(Seeds, GiveDifferentPackingsInTheScenesThatDrawOne) {
  std::set<std::string> with_chance;
  for (const EngineKind& kind : all_engines()) {
    for (const engine::BuiltinScene& scene : kind.builtin) {
      TrajectoryWish wish{.scene = std::string(scene.name)};
      wish.tolerances = {1e-1};
      wish.seeds = "2";
      if (plan_trajectories(wish).seed_matters) with_chance.emplace(scene.name);
    }
  }
  EXPECT_THAT(with_chance,
              ElementsAre("avalanche", "capsules-deposition", "collapse-2d", "column-cohesive",
                          "column-dry", "drum", "hopper", "mixed-shapes-heap", "shaker"));
}

class Trajectories : public test::OwnFolder {
 protected:
  std::filesystem::path runs() const { return folder_ / "runs.jsonl"; }
};

TEST_F(Trajectories, OfOneTaskAreAlikeAndThoseOfTwoSeedsAreNot) {
  const TrajectoryPlan plan = plan_trajectories(small_column());
  const auto once = run_trajectory(plan.tasks[0], [] {});
  const auto again = run_trajectory(plan.tasks[0], [] {});
  const auto other = run_trajectory(plan.tasks[3], [] {});
  ASSERT_TRUE(once && again && other);
  const auto at = [](const TrajectoryRow& row, Observable what) {
    return row.observed[static_cast<std::size_t>(what)];
  };
  for (const Observable what : {Observable::kFront, Observable::kEnergyChange,
                                Observable::kEnergyDrift, Observable::kCentreHeight}) {
    EXPECT_EQ(at(*once, what), at(*again, what));
    EXPECT_NE(at(*once, what), at(*other, what));
  }
  EXPECT_EQ(once->steps, 3);
}

TEST_F(Trajectories, WhatIsInTheFolderIsNotRunAgain) {
  const TrajectoryPlan plan = plan_trajectories(small_column());
  const TrajectoryRows first = run_trajectories(plan, folder_);
  EXPECT_EQ(first.earlier, 0u);
  const TrajectoryRows second = run_trajectories(plan, folder_);
  EXPECT_EQ(second.earlier, plan.tasks.size());
  ASSERT_EQ(second.rows.size(), first.rows.size());
  for (std::size_t k = 0; k < first.rows.size(); ++k) {
    EXPECT_EQ(second.rows[k].key, first.rows[k].key);
    for (const ObservableKind& kind : observables()) {
      const auto place = static_cast<std::size_t>(kind.what);
      const double a = first.rows[k].observed[place], b = second.rows[k].observed[place];
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << kind.key;
    }
  }
}

TEST_F(Trajectories, ALineCutShortIsRunAgainAndWhatFollowsStandsOnItsOwn) {
  const TrajectoryPlan plan = plan_trajectories(small_column());
  run_trajectories(plan, folder_);
  std::filesystem::resize_file(runs(), std::filesystem::file_size(runs()) - 20);
  EXPECT_EQ(run_trajectories(plan, folder_).earlier, plan.tasks.size() - 1);
  EXPECT_EQ(run_trajectories(plan, folder_).earlier, plan.tasks.size());
}

TEST_F(Trajectories, ALineThatIsNoRowIsAnInputErrorThatNamesIt) {
  std::filesystem::create_directories(folder_);
  std::ofstream(runs()) << "{\"key\": 3}\n";
  try {
    run_trajectories(plan_trajectories(small_column()), folder_);
    FAIL() << "expected an InputError";
  } catch (const problems::InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("runs.jsonl, line 1"));
  }
}

}  // namespace
}  // namespace conebench::harness
