// The median with its interval, the count of allocations, the calibration.

#include <dlfcn.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <random>
#include <vector>

#include "harness/allocations.h"
#include "harness/calibration.h"
#include "harness/median.h"
#include "problems/residual.h"

namespace conebench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<double> one_to(int n) {
  std::vector<double> values(static_cast<std::size_t>(n));
  std::iota(values.begin(), values.end(), 1.0);
  return values;
}

TEST(Median, IsTheMiddleValueOrTheMeanOfTheTwo) {
  EXPECT_EQ(median_interval({7.0}).median, 7.0);
  EXPECT_EQ(median_interval({9.0, 1.0, 4.0}).median, 4.0);
  EXPECT_EQ(median_interval({9.0, 1.0, 4.0, 6.0}).median, 5.0);
}

TEST(Median, FewerThanSixValuesBoundNothing) {
  for (int n = 1; n < 6; ++n) EXPECT_TRUE(std::isinf(median_interval(one_to(n)).spread())) << n;
  EXPECT_FALSE(std::isinf(median_interval(one_to(6)).spread()));
}

TEST(Median, RanksAreThoseOfTheTables) {
  // Conover, Practical Nonparametric Statistics, and any table of the sign test at 5 %, two-sided.
  const std::vector<std::pair<int, double>> lower = {{6, 1},   {8, 1},   {9, 2},   {10, 2},
                                                     {12, 3},  {15, 4},  {20, 6},  {25, 8},
                                                     {30, 10}, {50, 18}, {100, 40}};
  for (const auto& [n, rank] : lower) {
    const MedianInterval interval = median_interval(one_to(n));
    EXPECT_EQ(interval.low, rank) << n;
    EXPECT_EQ(interval.high, n + 1 - rank) << n;
  }
}

TEST(Median, LargeSamplesApproachTheNormalLaw) {
  const MedianInterval interval = median_interval(one_to(10'000));
  EXPECT_NEAR(interval.low, 5000.0 - 1.96 * 50.0, 2.0);  // n / 2 - 1.96 sqrt(n) / 2
  EXPECT_NEAR(interval.spread(), 98.0 / 5000.0, 1e-3);
}

TEST(Median, TheIntervalHoldsTheTrueMedianAsOftenAsItSays) {
  std::mt19937_64 random(1);
  std::exponential_distribution<double> skewed(1.0);
  int held = 0;
  constexpr int kTrials = 2000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<double> values(21);
    for (double& value : values) value = skewed(random);
    const MedianInterval interval = median_interval(values);
    if (interval.low <= std::log(2.0) && std::log(2.0) <= interval.high) ++held;
  }
  EXPECT_GE(held, 0.94 * kTrials);  // 97.3 % expected, standard deviation 0.4 %
}

#define SKIP_UNLESS_COUNTED() \
  if (!allocations_are_counted()) GTEST_SKIP() << "not counted under sanitizers"

TEST(Allocations, EveryKindIsCountedOnce) {
  SKIP_UNLESS_COUNTED();
  void* blocks[8] = {};
  AllocationCount count;
  blocks[0] = std::malloc(10);
  blocks[1] = std::calloc(10, 10);
  blocks[0] = std::realloc(blocks[0], 1000);
  blocks[2] = std::aligned_alloc(64, 128);
  EXPECT_EQ(::posix_memalign(&blocks[3], 64, 100), 0);
  blocks[4] = ::memalign(64, 100);
  blocks[5] = ::operator new(10);
  blocks[6] = ::operator new(10, std::align_val_t(64));
  const std::uint64_t calls = count.calls();
  EXPECT_EQ(calls, 8u);
  ::operator delete(blocks[6], std::align_val_t(64));
  ::operator delete(blocks[5]);
  for (int i = 0; i < 5; ++i) std::free(blocks[i]);
  EXPECT_EQ(count.calls(), calls) << "to free is no call for memory";
}

TEST(Allocations, WhatIsAskedForIsGiven) {
  SKIP_UNLESS_COUNTED();  // a sanitizer ends the program where POSIX has an error code
  void* block = nullptr;
  ASSERT_EQ(::posix_memalign(&block, 256, 1000), 0);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(block) % 256, 0u);
  std::free(block);
  EXPECT_EQ(::posix_memalign(&block, 3, 1000), EINVAL);
  const std::unique_ptr<char, decltype(&std::free)> zeros(static_cast<char*>(std::calloc(1000, 10)),
                                                          &std::free);
  EXPECT_TRUE(std::all_of(zeros.get(), zeros.get() + 10'000, [](char c) { return c == 0; }));
}

TEST(Allocations, ThoseOfALibraryLoadedLaterCount) {
  SKIP_UNLESS_COUNTED();
  void* const library = ::dlopen(CONEBENCH_ALLOCATING_LIBRARY, RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(library, nullptr) << ::dlerror();
  const auto allocate = reinterpret_cast<void (*)(int)>(::dlsym(library, "allocate"));
  ASSERT_NE(allocate, nullptr);
  AllocationCount count;
  allocate(7);
  EXPECT_EQ(count.calls(), 7u);
}

TEST(Allocations, NothingCountsOutsideAndWhilePaused) {
  SKIP_UNLESS_COUNTED();
  const auto allocate = [] {
    void* volatile block = std::malloc(10);
    std::free(block);
  };
  allocate();
  AllocationCount count;
  allocate();
  count.pause();
  allocate();
  count.resume();
  allocate();
  EXPECT_EQ(count.calls(), 2u);
}

// So many separate cones of each dimension, all pushed and dragged.
problems::Problem separate_cones(int of_each) {
  std::vector<problems::Cone> cones;
  int rows = 0;
  for (int k = 0; k < of_each; ++k) {
    for (const int dim : {1, 2, 3, 6}) {
      cones.push_back(problems::Cone::coulomb(dim, dim == 1 ? 0.0 : 0.5));
      rows += dim;
    }
  }
  problems::SparseMatrix W(rows, rows);
  W.setIdentity();
  return {problems::ReducedData{W, Eigen::VectorXd::Constant(rows, -1.0)}, cones, {}};
}

TEST(Allocations, AreNoneForEachConeThatIsJudged) {
  SKIP_UNLESS_COUNTED();
  const auto calls = [](int of_each) {
    const problems::Problem problem = separate_cones(of_each);
    const Eigen::VectorXd r = Eigen::VectorXd::Constant(problem.rows(), 0.25);
    AllocationCount count;
    EXPECT_GT(problems::evaluate_residual(problem, r).eta.max, 0.0);
    EXPECT_GT(problems::evaluate_eta(problem, r), 0.0);
    return count.calls();
  };
  EXPECT_EQ(calls(100), calls(1));
}

Calibration steady() {
  return {.arithmetic_s = 10e-3,
          .memory_s = 20e-3,
          .arithmetic_spread = 0.01,
          .memory_spread = 0.02,
          .processor_s = 1000.0,
          .stolen_s = 5.0,
          .frequency_hz = 3e9};
}

TEST(Calibration, MeasuresBothParts) {
  const Calibration calibration = calibrate();
  EXPECT_GT(calibration.arithmetic_s, 0.0);
  EXPECT_GT(calibration.memory_s, 0.0);
  EXPECT_TRUE(std::isfinite(calibration.arithmetic_spread));
  EXPECT_GT(calibration.processor_s, calibration.stolen_s);
}

TEST(Calibration, TheSameMachineHasNotDrifted) {
  Calibration after = steady();
  after.arithmetic_s *= 1.06;  // within 5 % and the two spreads of 1 %
  after.memory_s /= 1.08;
  after.processor_s += 100.0;
  after.stolen_s += 1.0;
  EXPECT_THAT(signs_of_drift(steady(), after), IsEmpty());
  EXPECT_FALSE(drifted(steady(), after));
}

TEST(Calibration, EachSignIsNamed) {
  Calibration slow = steady();
  slow.arithmetic_s *= 1.2;
  EXPECT_THAT(signs_of_drift(steady(), slow), ElementsAre(HasSubstr("arithmetic: +20.0 %")));
  EXPECT_TRUE(drifted(steady(), slow));

  Calibration busy = steady();
  busy.memory_s *= 0.8;  // faster at the end: the beginning was disturbed
  EXPECT_THAT(signs_of_drift(steady(), busy), ElementsAre(HasSubstr("memory traffic: -20.0 %")));

  Calibration throttled = steady();
  throttled.frequency_hz = 2e9;
  EXPECT_THAT(signs_of_drift(steady(), throttled), ElementsAre(HasSubstr("frequency")));

  Calibration robbed = steady();
  robbed.processor_s += 100.0;
  robbed.stolen_s += 3.0;
  EXPECT_THAT(signs_of_drift(steady(), robbed), ElementsAre(HasSubstr("3.0 %")));
}

TEST(Calibration, ANoisyMeasurementAllowsMore) {
  Calibration before = steady(), after = steady();
  before.arithmetic_spread = 0.2;
  after.arithmetic_s *= 1.2;
  EXPECT_FALSE(drifted(before, after));
}

}  // namespace
}  // namespace conebench::harness
