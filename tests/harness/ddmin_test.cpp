// Delta debugging on planted oracles: what must be left, and that nothing else can be left out.

#include "harness/ddmin.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

namespace conebench::harness {
namespace {

using testing::ElementsAre;

using Items = std::vector<int>;

Items first_numbers(int count) {
  Items items(static_cast<std::size_t>(count));
  std::iota(items.begin(), items.end(), 0);
  return items;
}

// Fails where all of these are there.
StillFails fails_with(const Items& all_of) {
  return [all_of](const Items& items) {
    return std::ranges::all_of(all_of, [&](int x) { return std::ranges::count(items, x) == 1; });
  };
}

TEST(Ddmin, LeavesExactlyTheTwoThatFailTogether) {
  for (int a = 0; a < 23; ++a) {
    for (int b = a + 1; b < 23; ++b) {
      const Minimum found = minimise(first_numbers(23), fails_with({a, b}));
      EXPECT_THAT(found.items, ElementsAre(a, b));
      EXPECT_TRUE(found.complete);
    }
  }
}

TEST(Ddmin, KeepsOneItemOfAnOracleThatAlwaysFails) {
  for (const int count : {1, 2, 3, 64, 65}) {
    const auto never_empty = [](const Items& items) {
      EXPECT_FALSE(items.empty());
      return true;
    };
    EXPECT_EQ(minimise(first_numbers(count), never_empty).items.size(), 1u);
  }
}

TEST(Ddmin, KeepsAllWhereEveryItemIsNeeded) {
  const Items all = first_numbers(17);
  EXPECT_EQ(minimise(all, fails_with(all)).items, all);
}

// An oracle without any order in it: a hash of the set decides. The whole set fails.
TEST(Ddmin, NoSingleItemOfTheResultCanBeLeftOut) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const Items all = first_numbers(1 + static_cast<int>(seed % 40));
    const StillFails erratic = [&](const Items& items) {
      std::seed_seq hash(items.begin(), items.end());
      std::mt19937 random(hash);
      return items == all || (random() + seed) % 3 == 0;
    };
    const Minimum found = minimise(all, erratic);
    ASSERT_TRUE(found.complete);
    EXPECT_TRUE(*erratic(found.items));
    EXPECT_TRUE(std::ranges::is_sorted(found.items));
    if (found.items.size() == 1) continue;
    for (std::size_t k = 0; k < found.items.size(); ++k) {
      Items without = found.items;
      without.erase(without.begin() + static_cast<std::ptrdiff_t>(k));
      EXPECT_FALSE(*erratic(without)) << "seed " << seed << ", item " << found.items[k];
    }
  }
}

// 2 m log2(n / m) of the header, and a last pass over the m that are left.
TEST(Ddmin, AsksLittleWhereFewMatter) {
  const Minimum found = minimise(first_numbers(1024), fails_with({17, 600, 601, 1000}));
  EXPECT_THAT(found.items, ElementsAre(17, 600, 601, 1000));
  EXPECT_LE(found.tests, 2u * 4u * 8u + 8u);
}

TEST(Ddmin, EndedEarlyItHasTheSmallestSetThatFailed) {
  Items smallest;
  int calls = 0;
  const StillFails impatient = [&](const Items& items) -> std::optional<bool> {
    if (++calls > 9) return std::nullopt;
    const bool fails = *fails_with({100, 101})(items);
    if (fails) smallest = items;
    return fails;
  };
  const Minimum found = minimise(first_numbers(512), impatient);
  EXPECT_FALSE(found.complete);
  EXPECT_EQ(found.tests, 9u);
  EXPECT_EQ(found.items, smallest);
  EXPECT_LT(found.items.size(), 512u);
}

}  // namespace
}  // namespace conebench::harness
