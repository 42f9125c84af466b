#include "solvers/forked.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <stdexcept>

namespace conebench::solvers {
namespace {

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

TEST(Forked, WhatTheChildWritesAndReturnsIsHere) {
  const SharedArray<double> numbers(3);
  const ProcessEnd end = run_forked(
      [&] {
        numbers[1] = 2.5;
        return 3;
      },
      kNoLimit);
  EXPECT_EQ(end.exit_code, 3);
  EXPECT_EQ(describe(end), "exit code 3");
  EXPECT_EQ(numbers[1], 2.5);
  EXPECT_EQ(numbers[2], 0.0);
}

TEST(Forked, ACrashIsAResult) {
  const ProcessEnd end = run_forked([]() -> int { std::abort(); }, kNoLimit);
  EXPECT_EQ(end.signal, SIGABRT);
  EXPECT_EQ(describe(end), "SIGABRT (Aborted)");
}

TEST(Forked, SoAreAnExceptionAndACallOfExit) {
  EXPECT_EQ(run_forked([]() -> int { throw std::runtime_error("no"); }, kNoLimit).exit_code,
            kLeftEarly);
  EXPECT_EQ(run_forked([]() -> int { std::exit(0); }, kNoLimit).exit_code, kLeftEarly);
}

TEST(Forked, AHangIsKilledAndLeavesWhatItHadWritten) {
  const SharedArray<double> numbers(1);
  const auto start = std::chrono::steady_clock::now();
  const ProcessEnd end = run_forked(
      [&]() -> int {
        numbers[0] = 1.0;
        while (true) ::pause();
      },
      0.05);
  EXPECT_TRUE(end.timed_out);
  EXPECT_EQ(describe(end), "killed at the time limit");
  EXPECT_EQ(numbers[0], 1.0);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
}

TEST(Forked, WhatTheChildHadStartedIsKilledWithIt) {
  const SharedArray<pid_t> grandchild(1);
  run_forked(
      [&]() -> int {
        const pid_t pid = ::fork();
        if (pid == 0) {
          while (true) ::pause();
        }
        grandchild[0] = pid;
        while (true) ::pause();
      },
      0.2);
  ASSERT_GT(grandchild[0], 0);
  // Killed, but reaped by whoever inherits it: at most a zombie, whose files are closed.
  const std::string files = "/proc/" + std::to_string(grandchild[0]) + "/fd";
  bool gone = false;
  for (int i = 0; i < 500 && !gone; ++i) {
    ::usleep(10'000);
    std::error_code error;
    gone = std::filesystem::is_empty(files, error) || error;
  }
  EXPECT_TRUE(gone);
}

TEST(Forked, TheChildPrintsNothingToStdout) {
  testing::internal::CaptureStdout();
  run_forked(
      [] {
        static_cast<void>(!::write(STDOUT_FILENO, "noise", 5));
        return 0;
      },
      kNoLimit);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace conebench::solvers
