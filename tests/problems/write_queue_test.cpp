// The queue between an engine and the thread that writes for it.

#include "problems/engine/write_queue.h"

#include <gtest/gtest.h>
#include <pthread.h>

#include <csignal>
#include <latch>
#include <stdexcept>
#include <vector>

namespace conebench::engine {
namespace {

TEST(WriteQueues, DoTheirWorkInOrderInAnotherThread) {
  std::vector<int> done;
  std::thread::id worker;
  WriteQueue queue({.jobs = 4, .bytes = 100});
  for (int k = 0; k < 50; ++k) {
    queue.push([&, k] { done.push_back(k), worker = std::this_thread::get_id(); }, 1);
  }
  queue.drain();
  ASSERT_EQ(done.size(), 50u);
  for (int k = 0; k < 50; ++k) EXPECT_EQ(done[static_cast<std::size_t>(k)], k);
  EXPECT_NE(worker, std::this_thread::get_id());
}

TEST(WriteQueues, AreLeftOnlyWhenAllIsDone) {
  int done = 0;
  {
    WriteQueue queue({});
    for (int k = 0; k < 10; ++k) queue.push([&] { ++done; }, 1);
  }
  EXPECT_EQ(done, 10);
}

// The work waits until it is let go, so that the queue is as full as the test wants it.
struct HeldWork {
  std::latch begun{1}, let_go{1};
  std::function<void()> work() {
    return [this] { begun.count_down(), let_go.wait(); };
  }
};

TEST(WriteQueues, LetNobodyWaitWhileThereIsRoom) {
  HeldWork held;
  WriteQueue queue({.jobs = 3, .bytes = 100});
  queue.push(held.work(), 40);
  queue.push([] {}, 30);
  queue.push([] {}, 30);
  EXPECT_EQ(queue.waits(), 0);
  EXPECT_EQ(queue.waited_s(), 0.0);
  held.let_go.count_down();
}

// Pushes while the queue is full: comes back only after the held work has been let go, which
// happens a while after the push began.
void expect_to_wait(WriteQueue::Limits limits, std::size_t first_bytes, std::size_t second_bytes) {
  HeldWork held;
  WriteQueue queue(limits);
  queue.push(held.work(), first_bytes);
  held.begun.wait();
  std::atomic<bool> let_go = false;
  std::thread other([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    let_go = true;
    held.let_go.count_down();
  });
  queue.push([] {}, second_bytes);
  EXPECT_TRUE(let_go);
  EXPECT_EQ(queue.waits(), 1);
  EXPECT_GT(queue.waited_s(), 0.0);
  other.join();
}

TEST(WriteQueues, AreFullByTheirNumberOfJobs) { expect_to_wait({.jobs = 1, .bytes = 100}, 1, 1); }
TEST(WriteQueues, AreFullByTheirBytes) { expect_to_wait({.jobs = 9, .bytes = 100}, 60, 41); }
TEST(WriteQueues, TakeWorkLargerThanTheyAreWhenEmpty) {
  expect_to_wait({.jobs = 9, .bytes = 100}, 1000, 1);
}

TEST(WriteQueues, DropWhatIsCancelledBeforeItIsBegun) {
  HeldWork held;
  std::vector<int> done;
  WriteQueue queue({.jobs = 4, .bytes = 100});
  const auto begun = queue.push(held.work(), 10);
  const auto first = queue.push([&] { done.push_back(1); }, 90);
  held.begun.wait();
  EXPECT_FALSE(queue.cancel(begun));
  EXPECT_TRUE(queue.cancel(first));
  EXPECT_FALSE(queue.cancel(first));
  const auto second = queue.push([&] { done.push_back(2); }, 90);  // there is room again
  EXPECT_EQ(queue.waits(), 0);
  held.let_go.count_down();
  queue.drain();
  EXPECT_EQ(done, std::vector{2});
  EXPECT_FALSE(queue.cancel(second));
}

TEST(WriteQueues, HandTheFirstFailureToWhoeverUsesThemNextAndStop) {
  HeldWork held;
  int done = 0;
  WriteQueue queue({});
  queue.push(held.work(), 1);
  queue.push([] { throw std::runtime_error("first"); }, 1);
  queue.push([] { throw std::runtime_error("second"); }, 1);
  queue.push([&] { ++done; }, 1);
  EXPECT_NO_THROW(queue.check());
  held.let_go.count_down();
  for (int k = 0; k < 2; ++k) {
    try {
      queue.drain();
      FAIL() << "no exception";
    } catch (const std::runtime_error& error) {
      EXPECT_STREQ(error.what(), "first");
    }
  }
  EXPECT_THROW(queue.check(), std::runtime_error);
  EXPECT_THROW(queue.push([&] { ++done; }, 1), std::runtime_error);
  EXPECT_EQ(done, 0);
}

TEST(WriteQueues, WakeWhoeverWaitsForRoomWhenTheWorkFails) {
  HeldWork held;
  WriteQueue queue({.jobs = 1, .bytes = 1});
  queue.push(
      [&] {
        held.work()();
        throw std::runtime_error("no room");
      },
      1);
  held.begun.wait();
  std::thread other([&] { held.let_go.count_down(); });
  EXPECT_THROW(queue.push([] {}, 1), std::runtime_error);
  other.join();
}

TEST(WriteQueues, LeaveSignalsToTheOtherThreads) {
  sigset_t blocked, here;
  WriteQueue queue({});
  queue.push([&] { pthread_sigmask(SIG_SETMASK, nullptr, &blocked); }, 1);
  queue.drain();
  pthread_sigmask(SIG_SETMASK, nullptr, &here);
  for (const int signal : {SIGINT, SIGTERM}) {
    EXPECT_EQ(sigismember(&blocked, signal), 1);
    EXPECT_EQ(sigismember(&here, signal), 0);
  }
}

}  // namespace
}  // namespace conebench::engine
