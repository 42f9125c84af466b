#include "results/binomial.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace conebench::results {
namespace {

TEST(BinomialLowerBound, HasClosedFormsAtTheEnds) {
  EXPECT_EQ(binomial_lower_bound(0, 10, 0.95), 0.0);
  // All of n: p^n = 1 - confidence.
  for (const int n : {1, 5, 59, 500}) {
    EXPECT_NEAR(binomial_lower_bound(n, n, 0.95), std::pow(0.05, 1.0 / n), 1e-12) << n;
  }
  // One of n: 1 - (1 - p)^n = 1 - confidence.
  EXPECT_NEAR(binomial_lower_bound(1, 20, 0.9), 1.0 - std::pow(0.9, 1.0 / 20), 1e-12);
}

TEST(BinomialLowerBound, GrowsWithSuccessesAndFallsWithConfidence) {
  for (int k = 1; k < 30; ++k) {
    EXPECT_LT(binomial_lower_bound(k, 30, 0.95), binomial_lower_bound(k + 1, 30, 0.95));
    EXPECT_LT(binomial_lower_bound(k, 30, 0.99), binomial_lower_bound(k, 30, 0.95));
    EXPECT_LT(binomial_lower_bound(k, 30, 0.95), k / 30.0);
  }
}

// What the name promises: it lies above the truth in at most 5 % of experiments.
TEST(BinomialLowerBound, CoversTheTruth) {
  std::mt19937 random(1);
  for (const double p : {0.3, 0.9, 0.99}) {
    std::binomial_distribution<int> draw(40, p);
    int missed = 0;
    for (int experiment = 0; experiment < 4000; ++experiment) {
      missed += binomial_lower_bound(draw(random), 40, 0.95) > p;
    }
    EXPECT_LE(missed, 0.05 * 4000 + 3.0 * std::sqrt(0.05 * 0.95 * 4000)) << p;
  }
}

TEST(RunLowerBound, IsTheBinomialOneWhereStepsDoNotHangTogether) {
  std::vector<bool> alternating(36);
  for (std::size_t i = 0; i < alternating.size(); i += 2) alternating[i] = true;
  EXPECT_EQ(run_lower_bound(alternating, 0.95), binomial_lower_bound(18, 36, 0.95));
  EXPECT_EQ(run_lower_bound(std::vector<bool>(36, true), 0.95), binomial_lower_bound(36, 36, 0.95));
  EXPECT_EQ(run_lower_bound({true}, 0.95), binomial_lower_bound(1, 1, 0.95));
}

// One half of the run succeeds and the other fails: little more than two trials.
TEST(RunLowerBound, IsLowWhereStepsHangTogether) {
  std::vector<bool> halves(36);
  std::fill_n(halves.begin(), 18, true);
  EXPECT_LT(run_lower_bound(halves, 0.95), 0.5 * binomial_lower_bound(18, 36, 0.95));
}

// Runs whose steps repeat the one before in four of five cases: the binomial bound lies above the
// truth in four times as many runs as 5 %, this one in few more.
TEST(RunLowerBound, CoversTheTruthOfCorrelatedSteps) {
  std::mt19937 random(2);
  std::bernoulli_distribution repeats(0.8), succeeds(0.7);
  int missed = 0, missed_by_binomial = 0;
  for (int experiment = 0; experiment < 2000; ++experiment) {
    std::vector<bool> steps = {succeeds(random)};
    while (steps.size() < 100) steps.push_back(repeats(random) ? steps.back() : succeeds(random));
    missed += run_lower_bound(steps, 0.95) > 0.7;
    missed_by_binomial += binomial_lower_bound(std::ranges::count(steps, true), 100, 0.95) > 0.7;
  }
  EXPECT_LE(missed, 0.1 * 2000);
  EXPECT_GE(missed_by_binomial, 0.2 * 2000);
}

}  // namespace
}  // namespace conebench::results
