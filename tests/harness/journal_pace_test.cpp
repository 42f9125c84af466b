// How long the records of a campaign wait for the disk: this program's own fdatasync() notes when
// it was last called.

#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <thread>

#include "harness/campaign.h"
#include "test_solvers.h"

namespace {

using Clock = std::chrono::steady_clock;  // the same for all processes of a machine

std::vector<Clock::time_point> syncs;

}  // namespace

extern "C" int fdatasync(int file) {
  const long done = ::syscall(SYS_fdatasync, file);
  syncs.push_back(Clock::now());
  return static_cast<int>(done);
}

namespace conebench::harness {
namespace {

// A time that a worker writes and its parent reads.
class SharedTime {
 public:
  SharedTime()
      : place_(static_cast<Clock::time_point*>(::mmap(nullptr, sizeof(Clock::time_point),
                                                      PROT_READ | PROT_WRITE,
                                                      MAP_SHARED | MAP_ANONYMOUS, -1, 0))) {}
  ~SharedTime() { ::munmap(place_, sizeof *place_); }
  SharedTime(const SharedTime&) = delete;
  SharedTime& operator=(const SharedTime&) = delete;
  Clock::time_point& get() const { return *place_; }

 private:
  Clock::time_point* place_;
};

// Seconds from the start of the second of two tasks, which is when the record of the first is
// written, to the next sync. The second one takes far longer than a record may wait.
double wait_for_the_disk() {
  const auto folder =
      std::filesystem::path(testing::TempDir()) / ("conebench-pace-" + std::to_string(::getpid()));
  std::filesystem::remove_all(folder);
  const SharedTime started;
  const solvers::Solver slow = solver_that("slow", [&](Eigen::VectorXd&) {
    started.get() = Clock::now();
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
  });
  std::vector<Task> tasks = tasks_of(small_plan({honest_solver(), slow}), {source_named("p")});
  if (tasks.front().solver->name == "slow") std::swap(tasks.front(), tasks.back());
  syncs.clear();
  run_campaign({.results_dir = folder}, tasks);
  std::filesystem::remove_all(folder);
  const auto next = std::find_if(syncs.begin(), syncs.end(),
                                 [&](Clock::time_point sync) { return sync > started.get(); });
  if (next == syncs.end()) return 1e9;
  return std::chrono::duration<double>(*next - started.get()).count();
}

// A busy machine may delay one attempt; asking too seldom delays all.
TEST(JournalPace, ARecordIsOnDiskWithinItsTimeThoughTheNextTaskTakesLonger) {
  double best_s = 1e9;
  for (int attempt = 0; attempt < 5 && best_s > results::Journal::kFlush_s; ++attempt) {
    best_s = std::min(best_s, wait_for_the_disk());
  }
  EXPECT_LE(best_s, results::Journal::kFlush_s);
}

}  // namespace
}  // namespace conebench::harness
