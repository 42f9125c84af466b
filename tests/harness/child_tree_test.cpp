// What a child process starts: all of it ends with the child.

#include <sys/wait.h>

#include <memory>

#include "tests/harness/child_helper.h"

namespace conebench::harness {
namespace {

TEST(Child, AGrandchildInASessionOfItsOwnDiesWithIt) {
  const Roll roll;
  const ChildOutcome outcome = run([&] {
    if (::fork() == 0) {
      ::setsid();
      ignore(SIGTERM);
      roll.sign();
      linger();
    }
    roll.wait_for(1);
    return std::string("done");
  });
  EXPECT_EQ(outcome.output, "done");
  roll.expect_all_gone(1);
}

TEST(Child, ADaemonThatForkedTwiceDiesWithIt) {
  const Roll roll;
  run([&] {
    if (::fork() == 0) {
      ::setsid();
      if (::fork() != 0) ::_exit(0);
      roll.sign();
      linger();
    }
    roll.wait_for(1);
    return std::string();
  });
  roll.expect_all_gone(1);
}

// Of `count` processes in all, process i starts 2 i + 1 and 2 i + 2, a third of them as sessions.
void start_tree(int i, int count, const Roll& roll) {
  for (const int next : {2 * i + 1, 2 * i + 2}) {
    if (next >= count || ::fork() != 0) continue;
    if (next % 3 == 0) ::setsid();
    ignore(SIGTERM);
    start_tree(next, count, roll);
    roll.sign();
    linger();
  }
}

TEST(Child, ATreeOfProcessesDiesWithIt) {
  const Roll roll;
  run([&] {
    start_tree(0, 51, roll);
    roll.wait_for(50);
    return std::string();
  });
  roll.expect_all_gone(50);
}

// It forks and leaves, again and again: nobody is ever where the last look saw somebody.
TEST(Child, AProcessThatHopsIsCaught) {
  const Roll roll;
  const auto start = std::chrono::steady_clock::now();
  const ChildOutcome outcome = run([&]() -> std::string {
    if (::fork() == 0) {
      roll.sign();
      for (;;) {
        if (::fork() > 0) ::_exit(0);
        ::setsid();
      }
    }
    roll.wait_for(1);
    return "done";
  });
  EXPECT_EQ(outcome.output, "done");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
}

TEST(Child, AnotherChildOfThisProcessIsLeftAlone) {
  const pid_t bystander = ::fork();
  if (bystander == 0) linger();
  run([]() -> std::string { linger(); }, {.wall_s = 0.1});
  EXPECT_EQ(state_of(bystander), 'S');
  ::kill(bystander, SIGKILL);
  ::waitpid(bystander, nullptr, 0);
}

TEST(Child, IsKilledWithAllItHasStartedWhenItsObjectGoes) {
  const Roll roll;
  {
    Child child(
        [&]() -> std::string {
          if (::fork() == 0) ::setsid();
          roll.sign();
          linger();
        },
        {});
    roll.wait_for(2);
  }
  roll.expect_all_gone(2);
}

TEST(Child, DiesWithItsParentHoweverThatEnds) {
  const Roll roll;
  const pid_t parent = ::fork();
  if (parent == 0) {
    const Child child(
        [&]() -> std::string {
          if (::fork() == 0) ::setsid();
          roll.sign();
          linger();
        },
        {});
    linger();
  }
  roll.wait_for(2);
  ::kill(parent, SIGKILL);
  ::waitpid(parent, nullptr, 0);
  const auto start = std::chrono::steady_clock::now();
  const auto gone = [&] {
    for (const pid_t pid : roll.pids()) {
      if (state_of(pid) != 'X' && state_of(pid) != 'Z') return false;  // init may reap slowly
    }
    return true;
  };
  while (!gone() && std::chrono::steady_clock::now() - start < std::chrono::seconds(5)) {
    ::usleep(1000);
  }
  EXPECT_TRUE(gone());
}

TEST(Child, AKilledSupervisorIsAKilledChild) {
  const ChildOutcome outcome = run([]() -> std::string {
    ::kill(::getppid(), SIGKILL);
    linger();
  });
  EXPECT_EQ(outcome.signal, SIGKILL);
  EXPECT_FALSE(outcome.timed_out);
  EXPECT_GT(outcome.wall_s, 0.0);
}

}  // namespace
}  // namespace conebench::harness
