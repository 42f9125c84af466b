// Which steps an export policy keeps, and how many each of them stands for.

#include "problems/engine/step_sample.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>

#include "problems/error.h"

namespace conebench::engine {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::int64_t> numbers(const std::vector<SampledStep>& steps) {
  std::vector<std::int64_t> out;
  for (const SampledStep& step : steps) out.push_back(step.step);
  return out;
}

double total_weight(const std::vector<SampledStep>& steps) {
  return std::accumulate(steps.begin(), steps.end(), 0.0,
                         [](double sum, const SampledStep& step) { return sum + step.weight; });
}

// Offers all, and keeps account of what the verdicts leave: it must be the sample, always.
std::vector<SampledStep> sample_of(const std::string& policy, const std::vector<StepFacts>& run,
                                   std::uint64_t seed = 1) {
  const StepSelection selection = parse_selection(policy);
  const auto sample = make_sample(selection, seed);
  std::set<std::int64_t> kept;
  for (const StepFacts& facts : run) {
    const StepSample::Verdict verdict = sample->offer(facts);
    EXPECT_TRUE(verdict.keep || !verdict.instead_of);
    if (verdict.instead_of) {
      EXPECT_EQ(kept.erase(*verdict.instead_of), 1u);
    }
    if (verdict.keep) kept.insert(facts.step);
    EXPECT_LE(std::ssize(kept), selection.most);
  }
  const auto steps = sample->steps();
  EXPECT_EQ(numbers(steps), std::vector(kept.begin(), kept.end()));
  return steps;
}

std::vector<StepFacts> plain_run(std::int64_t steps) {
  std::vector<StepFacts> run;
  for (std::int64_t step = 0; step < steps; ++step) run.push_back({.step = step, .cones = 10});
  return run;
}

std::string complaint(const std::string& policy) {
  try {
    parse_selection(policy);
  } catch (const problems::InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(StepSelections, AreReadFromTheCommandLine) {
  EXPECT_TRUE(parse_selection("all").contains(17));
  const StepSelection range = parse_selection("10..20");
  EXPECT_TRUE(range.contains(10) && range.contains(20));
  EXPECT_FALSE(range.contains(9) || range.contains(21));
  const StepSelection every = parse_selection("every:7");
  EXPECT_TRUE(every.contains(14) && !every.contains(15));
  EXPECT_EQ(every.sampling, Sampling::kNone);
  for (const auto& [text, sampling] :
       {std::pair("hardest:3", Sampling::kHardest), std::pair("reservoir:3", Sampling::kReservoir),
        std::pair("stratified:3", Sampling::kStratified)}) {
    const StepSelection selection = parse_selection(text);
    EXPECT_EQ(selection.sampling, sampling) << text;
    EXPECT_EQ(selection.most, 3) << text;
    EXPECT_TRUE(selection.contains(0) && selection.contains(1));
  }
}

TEST(StepSelections, OfOtherKindsAreRefusedWithASuggestion) {
  EXPECT_THAT(complaint("hardset:3"), HasSubstr("found \"hardset:3\", expected all, every:N"));
  EXPECT_THAT(complaint("hardset:3"), HasSubstr("did you mean 'hardest'?"));
  EXPECT_THAT(complaint("stratifed:3"), HasSubstr("did you mean 'stratified'?"));
  EXPECT_THAT(complaint("evry:3"), HasSubstr("did you mean 'every'?"));
  for (const char* wrong : {"hardest", "hardest:", "hardest:0", "hardest:-1", "hardest:2.5",
                            "hardest:2x", "reservoir:99999999999999999999", "reservoir: 3", "all:3",
                            "every:0", "every:x", "3..", "-1..3", "none", "", "..", "4..3"}) {
    EXPECT_THAT(complaint(wrong), HasSubstr("expected")) << wrong;
    EXPECT_THAT(complaint(wrong), Not(HasSubstr("did you mean"))) << wrong;
  }
}

TEST(StepSamples, AreNotTakenOfARange) {
  EXPECT_EQ(make_sample(parse_selection("all"), 1), nullptr);
}

TEST(HardestSteps, AreThoseThatFailedAndThenThoseOfMostIterations) {
  const std::vector<StepFacts> run = {{.step = 0, .cones = 5, .iterations = 30},
                                      {.step = 1, .cones = 5, .iterations = 2, .converged = false},
                                      {.step = 2, .cones = 9, .iterations = 40},
                                      {.step = 3, .cones = 5, .iterations = 40},
                                      {.step = 4, .cones = 9, .iterations = 40},
                                      {.step = 5, .cones = 5, .iterations = 90, .converged = false},
                                      {.step = 6, .cones = 99, .iterations = 10}};
  EXPECT_THAT(numbers(sample_of("hardest:1", run)), ElementsAre(5));
  EXPECT_THAT(numbers(sample_of("hardest:2", run)), ElementsAre(1, 5));
  EXPECT_THAT(numbers(sample_of("hardest:3", run)), ElementsAre(1, 2, 5));
  EXPECT_THAT(numbers(sample_of("hardest:4", run)), ElementsAre(1, 2, 4, 5));
  EXPECT_THAT(numbers(sample_of("hardest:5", run)), ElementsAre(1, 2, 3, 4, 5));
  EXPECT_THAT(numbers(sample_of("hardest:99", run)), ElementsAre(0, 1, 2, 3, 4, 5, 6));
  for (const SampledStep& step : sample_of("hardest:3", run)) EXPECT_EQ(step.weight, 1.0);
}

TEST(HardestSteps, AreAlikeInWhateverOrderTheyCome) {
  std::vector<StepFacts> run;
  for (std::int64_t step = 0; step < 60; ++step) {
    run.push_back({.step = step, .cones = step % 7, .iterations = step * step % 23});
  }
  const auto expected = numbers(sample_of("hardest:11", run));
  std::ranges::reverse(run);
  EXPECT_EQ(numbers(sample_of("hardest:11", run)), expected);
}

TEST(Reservoirs, StandForAllSteps) {
  for (const std::int64_t steps : {1, 9, 10, 11, 1000}) {
    const auto sample = sample_of("reservoir:10", plain_run(steps));
    EXPECT_EQ(std::ssize(sample), std::min<std::int64_t>(steps, 10));
    EXPECT_NEAR(total_weight(sample), static_cast<double>(steps), 1e-9);
    for (const SampledStep& step : sample) EXPECT_EQ(step.weight, sample[0].weight);
  }
}

TEST(Reservoirs, AreAlikeForASeedAndDifferForAnother) {
  const auto run = plain_run(500);
  EXPECT_EQ(numbers(sample_of("reservoir:10", run, 7)), numbers(sample_of("reservoir:10", run, 7)));
  EXPECT_NE(numbers(sample_of("reservoir:10", run, 7)), numbers(sample_of("reservoir:10", run, 8)));
}

// Pearson's statistic for counts that should all be alike.
double chi_square(const std::vector<int>& counts) {
  const double expected =
      std::accumulate(counts.begin(), counts.end(), 0.0) / static_cast<double>(counts.size());
  double sum = 0.0;
  for (const int count : counts) sum += (count - expected) * (count - expected) / expected;
  return sum;
}

// The same for how often each of n steps is among the `size` taken, over many draws without
// replacement: counts of a draw have the covariance p (1 - p) n / (n - 1) times that of n counts
// that sum up to nothing, so that this, not chi_square, has n - 1 degrees of freedom.
double chi_square_of_draws(const std::vector<int>& counts, double size) {
  const auto n = static_cast<double>(counts.size());
  return chi_square(counts) / ((1.0 - size / n) * n / (n - 1.0));
}

// 4000 seeds; chi-square with 39 degrees of freedom has 1e-4 tails at 14.3 and 80.6.
TEST(Reservoirs, TakeEveryStepAsOften) {
  std::vector<int> counts(40);
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    for (const std::int64_t step : numbers(sample_of("reservoir:8", plain_run(40), seed))) {
      ++counts[static_cast<std::size_t>(step)];
    }
  }
  EXPECT_GT(chi_square_of_draws(counts, 8), 14.3);
  EXPECT_LT(chi_square_of_draws(counts, 8), 80.6);
}

// All pairs of 6 steps: 15 sets, 3000 seeds; 14 degrees of freedom, 1e-4 tails at 2.06 and 42.6.
TEST(Reservoirs, TakeEverySetAsOften) {
  std::map<std::vector<std::int64_t>, int> sets;
  for (std::uint64_t seed = 0; seed < 3000; ++seed) {
    ++sets[numbers(sample_of("reservoir:2", plain_run(6), seed))];
  }
  ASSERT_EQ(sets.size(), 15u);
  std::vector<int> counts;
  for (const auto& [set, count] : sets) counts.push_back(count);
  EXPECT_GT(chi_square(counts), 2.06);
  EXPECT_LT(chi_square(counts), 42.6);
}

// Strata by the number of bits of cones and iterations, steps in a row; `sizes` are steps in each.
std::vector<StepFacts> run_of_strata(const std::vector<int>& sizes) {
  std::vector<StepFacts> run;
  for (std::size_t stratum = 0; stratum < sizes.size(); ++stratum) {
    for (int k = 0; k < sizes[stratum]; ++k) {
      run.push_back({.step = std::ssize(run),
                     .cones = std::int64_t{1} << stratum,
                     .iterations = std::int64_t{1} << (stratum % 3)});
    }
  }
  return run;
}

std::vector<StepFacts> reordered(std::vector<StepFacts> run, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::shuffle(run.begin(), run.end(), random);
  for (std::size_t i = 0; i < run.size(); ++i) run[i].step = static_cast<std::int64_t>(i);
  return run;
}

struct Share {
  int offered = 0, kept = 0;
  double weight = 0.0;
};

std::map<std::int64_t, Share> shares(const std::vector<StepFacts>& run,
                                     const std::vector<SampledStep>& sample) {
  std::map<std::int64_t, Share> of_cones;
  for (const StepFacts& facts : run) ++of_cones[facts.cones].offered;
  for (const SampledStep& step : sample) {
    Share& share = of_cones[run[static_cast<std::size_t>(step.step)].cones];
    ++share.kept;
    share.weight += step.weight;
  }
  return of_cones;
}

// K = 20 of 4 strata: 2 keep both of their steps, the others 6 each, give or take one.
TEST(StratifiedSteps, AreAsEvenAsTheStrataAllowInAnyOrder) {
  const auto in_a_row = run_of_strata({300, 2, 50, 1000});
  std::vector<std::vector<StepFacts>> runs = {in_a_row};
  for (std::uint64_t seed = 1; seed <= 20; ++seed) runs.push_back(reordered(in_a_row, seed));
  for (const auto& run : runs) {
    const auto sample = sample_of("stratified:20", run);
    EXPECT_EQ(sample.size(), 20u);
    EXPECT_NEAR(total_weight(sample), 1352.0, 1e-9);
    for (const auto& [cones, share] : shares(run, sample)) {
      EXPECT_NEAR(share.weight, share.offered, 1e-9) << cones;
      if (share.offered == 2) {
        EXPECT_EQ(share.kept, 2);
      } else {
        EXPECT_NEAR(share.kept, 6, 1) << cones;
      }
    }
  }
}

TEST(StratifiedSteps, AreAllOfThemWhereThereIsRoom) {
  const auto run = run_of_strata({3, 4, 5});
  const auto sample = sample_of("stratified:12", run);
  EXPECT_EQ(sample.size(), 12u);
  for (const SampledStep& step : sample) EXPECT_EQ(step.weight, 1.0);
}

TEST(StratifiedSteps, TellApartPowersOfTwoOfConesAndOfIterations) {
  const std::vector<StepFacts> run = {
      {.step = 0, .cones = 4, .iterations = 0},  {.step = 1, .cones = 7, .iterations = 0},
      {.step = 2, .cones = 8, .iterations = 0},  {.step = 3, .cones = 15, .iterations = 0},
      {.step = 4, .cones = 15, .iterations = 1}, {.step = 5, .cones = 15, .iterations = 2},
      {.step = 6, .cones = 15, .iterations = 3}};
  const auto sample = sample_of("stratified:4", run);
  ASSERT_EQ(sample.size(), 4u);  // {0, 1}, {2, 3}, {4}, {5, 6}
  EXPECT_THAT(sample[0].step, testing::AnyOf(0, 1));
  EXPECT_THAT(sample[1].step, testing::AnyOf(2, 3));
  EXPECT_EQ(sample[2].step, 4);
  EXPECT_THAT(sample[3].step, testing::AnyOf(5, 6));
  EXPECT_EQ(sample[2].weight, 1.0);
  EXPECT_EQ(sample[0].weight * sample[1].weight * sample[3].weight, 8.0);
}

// With more strata than places, every step is still represented, by the nearest stratum.
TEST(StratifiedSteps, OfStrataBeyondTheLastPlaceCountAsTheNearest) {
  const auto run = run_of_strata({5, 5, 5, 5, 5, 5, 5, 5});
  const auto sample = sample_of("stratified:3", run);
  ASSERT_EQ(sample.size(), 3u);
  EXPECT_NEAR(total_weight(sample), 40.0, 1e-9);
  EXPECT_EQ(sample_of("stratified:1", run).at(0).weight, 40.0);
}

// A stratum that gives up places to another still keeps its steps as often, early or late ones:
// 4000 seeds, 4 of 30 steps; 29 degrees of freedom, 1e-4 tails at 8.73 and 66.2.
TEST(StratifiedSteps, AreUniformWithinAStratum) {
  std::vector<StepFacts> run;
  for (std::int64_t step = 0; step < 48; ++step) {
    const bool late = step >= 12 && step % 2 == 0;
    run.push_back({.step = step, .cones = late ? 100 : 10});
  }
  std::vector<int> counts;
  std::map<std::int64_t, int> kept;
  for (const StepFacts& facts : run) {
    if (facts.cones == 10) kept[facts.step] = 0;
  }
  for (std::uint64_t seed = 0; seed < 4000; ++seed) {
    for (const std::int64_t step : numbers(sample_of("stratified:8", run, seed))) {
      if (kept.contains(step)) ++kept[step];
    }
  }
  for (const auto& [step, count] : kept) counts.push_back(count);
  EXPECT_EQ(counts.size(), 30u);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0), 4 * 4000);
  EXPECT_GT(chi_square_of_draws(counts, 4), 8.73);
  EXPECT_LT(chi_square_of_draws(counts, 4), 66.2);
}

}  // namespace
}  // namespace conebench::engine
