#include "harness/cgroup.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace conebench::harness {
namespace {

TEST(MemoryCgroups, AreLookedForAboveTheOwnGroupButNotAboveTheTop) {
  const std::filesystem::path top = testing::TempDir() + "conebench-cgroup/";
  std::filesystem::create_directories(top / "slice/session");
  const auto offers = [&](const char* group, const char* controllers) {
    std::ofstream(top / group / "cgroup.subtree_control") << controllers << "\n";
  };
  offers("", "cpu memory");
  offers("slice", "cpu memory pids");
  offers("slice/session", "");
  EXPECT_EQ(find_memory_cgroups(top / "slice/session", top), top / "slice");
  EXPECT_EQ(find_memory_cgroups(top / "slice", top), top / "slice");
  offers("slice", "cpu pids");
  EXPECT_EQ(find_memory_cgroups(top / "slice/session", top), std::nullopt);
  offers("", "cpu");
  EXPECT_EQ(find_memory_cgroups(top, top), std::nullopt);
  std::filesystem::remove_all(top);
}

TEST(MemoryCgroups, AGroupSaysItsLimitAndWhetherItCostALife) {
  const std::filesystem::path top = testing::TempDir() + "conebench-cgroup";
  std::filesystem::create_directories(top);
  {
    const MemoryCgroup group(top, 4096);
    std::string limit;
    std::ifstream(group.path() / "memory.max") >> limit;
    EXPECT_EQ(limit, "4096");
    EXPECT_FALSE(group.has_killed());
    std::ofstream(group.path() / "memory.events") << "low 0\nmax 7\noom 1\noom_kill 1\n";
    EXPECT_TRUE(group.has_killed());
  }
  std::filesystem::remove_all(top);
}

}  // namespace
}  // namespace conebench::harness
