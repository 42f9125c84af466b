#include "results/binomial.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

}  // namespace
}  // namespace conebench::results
