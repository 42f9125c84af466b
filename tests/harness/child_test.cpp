// One child process: its output, its end, its limits.

#include <chrono>
#include <thread>

#include "harness/cgroup.h"
#include "tests/harness/child_helper.h"

namespace conebench::harness {
namespace {

using testing::EndsWith;
using testing::HasSubstr;

TEST(Child, ReturnsWhatTheWorkReturns) {
  const ChildOutcome outcome = run([] { return std::string(1 << 20, 'x'); });
  EXPECT_EQ(outcome.output, std::string(1 << 20, 'x'));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.signal, 0);
  EXPECT_FALSE(outcome.timed_out);
  EXPECT_GT(outcome.wall_s, 0.0);
  EXPECT_GT(outcome.peak_memory_bytes, 1u << 20);
}

TEST(Child, AnExceptionIsAnExitCodeAndALineOfStderr) {
  const ChildOutcome outcome = run([]() -> std::string { throw std::logic_error("no way"); });
  EXPECT_EQ(outcome.exit_code, kUncaughtExit);
  EXPECT_THAT(outcome.errors, HasSubstr("no way"));
}

TEST(Child, ASignalIsNamed) {
  const ChildOutcome outcome = run([]() -> std::string { std::abort(); });
  EXPECT_EQ(outcome.signal, SIGABRT);
  EXPECT_THAT(describe_end(outcome), HasSubstr("SIGABRT"));
}

TEST(Child, HasNoFileOfItsParentsButTheThreeStreamsAndItsOutput) {
  const ChildOutcome outcome = run([] {
    std::string open;
    for (int fd = 0; fd < 1024; ++fd) {
      if (::fcntl(fd, F_GETFD) >= 0) open += std::to_string(fd) + " ";
    }
    return open;
  });
  EXPECT_EQ(outcome.output, "0 1 2 3 ");
}

TEST(Child, IsToldAtTheSoftLimitAndMaySaveItsWork) {
  const auto work = [] {
    sigset_t term;
    sigemptyset(&term);
    sigaddset(&term, SIGTERM);
    ::sigprocmask(SIG_BLOCK, &term, nullptr);
    int signal = 0;
    ::sigwait(&term, &signal);
    return std::string("saved");
  };
  const ChildOutcome outcome = run(work, {.wall_s = 30.0, .soft_wall_s = 0.2});
  EXPECT_EQ(outcome.output, "saved");
  EXPECT_TRUE(outcome.timed_out);
  EXPECT_GE(outcome.wall_s, 0.2);
  EXPECT_LT(outcome.wall_s, 0.2 + kLate_s);
}

TEST(Child, EndsAtTheSoftLimitIfItDoesNotHandleIt) {
  const ChildOutcome outcome =
      run([]() -> std::string { linger(); }, {.wall_s = 30.0, .soft_wall_s = 0.2});
  EXPECT_EQ(outcome.signal, SIGTERM);
  EXPECT_TRUE(outcome.timed_out);
  EXPECT_THAT(describe_end(outcome), HasSubstr("killed after"));
}

TEST(Child, IsKilledAtTheHardLimitIfItIgnoresTheSoftOne) {
  const auto work = []() -> std::string {
    ignore(SIGTERM);
    linger();
  };
  const ChildOutcome outcome = run(work, {.wall_s = 0.5, .soft_wall_s = 0.2});
  EXPECT_EQ(outcome.signal, SIGKILL);
  EXPECT_TRUE(outcome.timed_out);
  EXPECT_GE(outcome.wall_s, 0.5);
  EXPECT_LT(outcome.wall_s, 0.5 + kLate_s);
}

TEST(Child, ABusyLoopEndsAtTheSoftProcessorLimit) {
  const ChildOutcome outcome = run([]() -> std::string { spin(); }, {.soft_cpu_s = 1.0});
  EXPECT_EQ(outcome.signal, SIGXCPU);
  EXPECT_TRUE(outcome.timed_out);
  EXPECT_GE(outcome.cpu_s, 0.9);  // the limit counts ticks
  EXPECT_LT(outcome.cpu_s, 1.0 + kLate_s);
}

TEST(Child, ABusyLoopIsKilledAtTheHardProcessorLimitWhateverItIgnores) {
  const auto work = []() -> std::string {
    ignore(SIGXCPU);
    spin();
  };
  const ChildOutcome outcome = run(work, {.cpu_s = 2.0, .soft_cpu_s = 1.0});
  EXPECT_EQ(outcome.signal, SIGKILL);
  EXPECT_TRUE(outcome.timed_out);
  EXPECT_FALSE(outcome.out_of_memory);
  EXPECT_LT(outcome.cpu_s, 2.0 + kLate_s);
}

TEST(Child, AddressSpaceIsLimited) {
  if (memory_limits_are_off()) GTEST_SKIP() << "address space is not limited under sanitizers";
  const auto work = [] {
    const std::unique_ptr<void, decltype(&std::free)> block(std::malloc(std::size_t{1} << 31),
                                                            &std::free);
    return std::string(block ? "given" : "refused");
  };
  EXPECT_EQ(run(work).output, "given");
  EXPECT_EQ(run(work, {.memory_bytes = std::uint64_t{1} << 30}).output, "refused");
}

TEST(Child, TheMemoryOfAllItsProcessesIsLimited) {
  if (!memory_cgroups()) GTEST_SKIP() << "no writable control group with the memory controller";
  const auto work = []() -> std::string {
    for (int i = 0; i < 4; ++i) {
      if (::fork() == 0) break;
    }
    std::vector<char> block(48 << 20, 'x');  // each within the limit, together not
    linger();
  };
  const ChildOutcome outcome = run(work, {.wall_s = 20.0, .memory_bytes = 128ULL << 20});
  EXPECT_TRUE(outcome.out_of_memory);
  EXPECT_FALSE(outcome.timed_out);
}

TEST(Child, ThatHasClosedItsOutputIsStillWaitedFor) {
  const auto work = [] {
    for (int fd = 0; fd < 16; ++fd) ::close(fd);
    ::usleep(300'000);
    return std::string("to nobody");
  };
  const ChildOutcome outcome = run(work);
  EXPECT_EQ(outcome.output, "");
  EXPECT_GE(outcome.wall_s, 0.3);
}

TEST(Child, ThatHasClosedItsOutputAndLingersIsKilled) {
  const auto work = []() -> std::string {
    for (int fd = 0; fd < 16; ++fd) ::close(fd);
    linger();
  };
  EXPECT_TRUE(run(work, {.wall_s = 0.3}).timed_out);
}

TEST(Child, OfTenMegabytesOfStderrTheTailIsKept) {
  const auto work = [] {
    const std::string line(99, 'e');
    for (int i = 0; i < 100'000; ++i) std::fprintf(stderr, "%s\n", line.c_str());
    std::fputs("the end", stderr);
    return std::string("done");
  };
  const ChildOutcome outcome = run(work);
  EXPECT_EQ(outcome.output, "done");
  EXPECT_THAT(outcome.errors, EndsWith("the end"));
  EXPECT_LE(outcome.errors.size(), 4000u);
}

TEST(Child, EndlessStdoutGoesNowhere) {
  const auto work = []() -> std::string {
    const std::string block(1 << 20, 'o');
    while (::write(STDOUT_FILENO, block.data(), block.size()) > 0) {
    }
    return "stopped";
  };
  const ChildOutcome outcome = run(work, {.wall_s = 0.5});
  EXPECT_TRUE(outcome.timed_out);
  EXPECT_EQ(outcome.output, "");
  EXPECT_LT(outcome.wall_s, 0.5 + kLate_s);
}

TEST(Child, TheProcessorTimeOfWhatItStartedCounts) {
  const auto work = [] {
    for (int i = 0; i < 2; ++i) {
      if (::fork() == 0) {
        ::setsid();
        while (std::clock() < CLOCKS_PER_SEC / 4) {
        }
        ::_exit(0);
      }
    }
    ::wait(nullptr);  // of the other the supervisor knows
    ::usleep(300'000);
    return std::string();
  };
  EXPECT_GE(run(work).cpu_s, 0.3);
}

}  // namespace
}  // namespace conebench::harness
