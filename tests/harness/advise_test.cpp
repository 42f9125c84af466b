// Advice: who wins a race, what is promised, and what the verb says.

#include "harness/advise.h"

#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "problems/made_backwards.h"
#include "results/binomial.h"
#include "tests/harness/program_test.h"

namespace conebench::harness {
namespace {

using testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Sample> samples(int count, std::uint64_t seed) {
  std::vector<Sample> out;
  for (int k = 0; k < count; ++k) {
    auto problem =
        problems::make_backwards({.cones = 20, .seed = seed + static_cast<std::uint64_t>(k)})
            .problem;
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(problem.rows());
    out.push_back({std::move(problem), zero});
  }
  return out;
}

TEST(Advise, AnEntrantCountsItsSteps) {
  const Entrant entrant{.solver = "gs", .times_s = {1.0, kInfinity, 3.0, 2.0}};
  EXPECT_EQ(entrant.solved(), 3);
  EXPECT_EQ(entrant.within(2.0), 2);
  EXPECT_EQ(entrant.quantile_s(0.5), 2.0);
  EXPECT_EQ(entrant.quantile_s(0.75), 3.0);
  EXPECT_EQ(entrant.quantile_s(0.9), kInfinity);
}

// One projected step a sweep, strongly damped, does not get to 1e-10 in the iterations there are.
TEST(Advise, TheSolverThatNeverGetsThereLeavesTheRace) {
  const Wish wish{.tol = 1e-10, .budget_s = 0.05};
  const auto entrants =
      race(samples(12, 5), {"gs[local=projection,omega=0.05]", "newton-ac"}, wish, true);
  ASSERT_EQ(entrants.size(), 2u);
  EXPECT_LT(entrants[0].times_s.size(), entrants[1].times_s.size());
  EXPECT_TRUE(entrants[0].dropped);
  EXPECT_FALSE(entrants[1].dropped);
  EXPECT_EQ(entrants[1].solved(), 12);
}

TEST(Advise, ARaceMeetsStepsFromAllPartsOfARunSoon) {
  for (const std::size_t count : {8u, 40u, 100u}) {
    const std::vector<std::size_t> order = spread_order(count);
    EXPECT_EQ(std::set<std::size_t>(order.begin(), order.end()).size(), count);
    std::set<std::size_t> quarters;
    for (std::size_t k = 0; k < 8; ++k) quarters.insert(4 * order[k] / count);
    EXPECT_EQ(quarters.size(), 4u) << count;
  }
}

TEST(Advise, OneHardStepAmongEasyOnesIsNoReasonToLeave) {
  const Wish wish{.tol = 1e-8, .budget_s = 2.0};
  const Entrant leader{.solver = "steady", .times_s = {1.0, 1.0, 1.0, 3.0}};
  const Entrant quick{.solver = "quick", .times_s = {0.1, 0.1, 0.1, kInfinity}};
  EXPECT_FALSE(out_of_the_race(quick, leader, wish));
  const Entrant slow{.solver = "slow", .times_s = {1.9, 4.1, 4.1, 4.1}};
  EXPECT_TRUE(out_of_the_race(slow, leader, wish));
  const Entrant near{.solver = "near", .times_s = {1.9, 1.9, 4.1, 4.1}};
  EXPECT_FALSE(out_of_the_race(near, leader, wish));
}

TEST(Advise, AShareThatIsSurelySmallerIsAReasonToLeave) {
  const Wish wish{.tol = 1e-8, .budget_s = 2.0};
  const Entrant leader{.solver = "sure", .times_s = std::vector<double>(12, 1.0)};
  Entrant misses{.solver = "misses", .times_s = std::vector<double>(12, 3.0)};
  EXPECT_TRUE(out_of_the_race(misses, leader, wish));
  std::fill_n(misses.times_s.begin(), 10, 1.0);
  EXPECT_FALSE(out_of_the_race(misses, leader, wish));
}

TEST(Advise, PromisesWhatUnseenStepsBear) {
  const Wish wish{.tol = 1e-8, .budget_s = 5.0, .confidence = 0.9};
  const Advice advice =
      advise(samples(8, 5), samples(20, 100), {"newton-ac", "gs"}, wish, true, 7.0);
  EXPECT_TRUE(advice.meets);
  EXPECT_EQ(advice.policy.probability, results::binomial_lower_bound(20, 20, 0.9));
  EXPECT_EQ(advice.single_best, 1.0);
  EXPECT_EQ(advice.virtual_best, 1.0);
  EXPECT_LE(advice.nearest_budget_s, wish.budget_s);
  ASSERT_EQ(advice.policy.ladder.back().solver, "auto");
  EXPECT_EQ(advice.policy.ladder.back().time_limit_s, 7.0);
  EXPECT_EQ(advice.policy.ladder.front().time_limit_s, wish.budget_s);
}

TEST(Advise, SaysSoWhenNoneMeetsTheBudget) {
  const Wish wish{.tol = 1e-8, .budget_s = 1e-9, .confidence = 0.9};
  const Advice advice = advise(samples(4, 5), samples(4, 100), {"newton-ac"}, wish, true, 7.0);
  EXPECT_FALSE(advice.meets);
  EXPECT_EQ(advice.policy.probability, 0.0);
  EXPECT_EQ(advice.single_best, 0.0);
}

using AdviseVerb = ProgramTest;

TEST_F(AdviseVerb, WritesAPolicyThatBothEnginesTake) {
  const Ran ran = conebench(
      "advise stack --budget 1s --tol 1e-6 --samples 10 -s gs newton-ac -o policy.toml --json");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto advice = nlohmann::json::parse(ran.out);
  EXPECT_TRUE(advice["meets"]);
  EXPECT_GT(advice["probability"], 0.5);
  EXPECT_GE(advice["validation_steps"], 4);
  for (const std::string scene : {"stack --steps 200",
                                  "sand-column --steps 30 --set "
                                  "grid.cells=[16,4] --set grid.size_m=[4,1]"}) {
    const Ran run = conebench("simulate " + scene + " -s policy:policy.toml --json");
    ASSERT_EQ(run.code, 0) << run.err;
    const auto summary = nlohmann::json::parse(run.out);
    EXPECT_EQ(summary["steps_not_converged"], 0);
    EXPECT_GT(summary["iterations"], 0);
  }
}

// The stack is the same for every seed; a second run of it has nothing unseen.
TEST_F(AdviseVerb, JudgesOnAnotherSeedOnlyWhereThatIsAnotherRun) {
  const Ran same = conebench("advise stack --budget 1s --tol 1e-6 --samples 8 -s gs");
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("windows of one run in turn"));
  EXPECT_THAT(same.out, HasSubstr("the seed changes nothing"));
  const std::string sand =
      "advise sand-column --set grid.cells=[16,4] --set duration_s=0.1 --budget 1s --samples 8 -s "
      "gs";
  EXPECT_THAT(conebench(sand).out, HasSubstr("it does with --set blocks[0].jitter=0.5"));
  const Ran other = conebench(sand + " --set blocks[0].jitter=0.5");
  EXPECT_THAT(other.out, HasSubstr("seed 1 to choose, seed 2 to judge")) << other.err;
}

TEST_F(AdviseVerb, TakesExportedProblems) {
  ASSERT_EQ(conebench("export stack --every 10 --steps 120 -o problems").code, 0);
  const Ran ran = conebench("advise problems --budget 1s --tol 1e-6 -s newton-ac gs");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("P(time <= budget and eta <= tol) >= "));
  EXPECT_THAT(ran.out, HasSubstr("virtual best 100 %"));
}

TEST_F(AdviseVerb, NoneMeetsAnImpossibleBudget) {
  const Ran ran = conebench("advise stack --budget 1ns --samples 6 -s gs");
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("none meets this budget"));
}

TEST_F(AdviseVerb, RefusesModelsAndWrongUnits) {
  EXPECT_EQ(conebench("advise stack --budget 4lightyears").code, 2);
  const Ran model = conebench("advise stack --budget 4ms -s ccp");
  EXPECT_EQ(model.code, 2);
  EXPECT_THAT(model.err, HasSubstr("is a model"));
}

}  // namespace
}  // namespace conebench::harness
