#include "harness/pool.h"

#include <sched.h>

#include <memory>

#include "harness/interrupt.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

struct Slot {
  std::size_t number = 0;
  std::optional<int> core;
  std::unique_ptr<Child> child;
};

std::vector<Slot> make_slots(int jobs) {
  const std::vector<int> cores = allowed_cores();
  problems::require(jobs >= 1 && jobs <= static_cast<int>(cores.size()), "--jobs", jobs,
                    " at a time, expected 1 to the ", cores.size(), " cores of this process");
  std::vector<Slot> slots(static_cast<std::size_t>(jobs));
  if (jobs > 1) {
    for (std::size_t i = 0; i < slots.size(); ++i) slots[i].core = cores[i];
  }
  return slots;
}

void start(Slot& slot, std::size_t number, const PoolCallbacks& callbacks) {
  Job job = callbacks.make(number);
  job.limits.core = slot.core;
  slot.number = number;
  slot.child = std::make_unique<Child>(job.work, job.limits);
}

}  // namespace

std::vector<int> allowed_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  std::vector<int> cores;
  if (::sched_getaffinity(0, sizeof set, &set) != 0) return {0};
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(static_cast<std::size_t>(core), &set)) cores.push_back(core);
  }
  return cores;
}

bool run_pool(std::size_t count, int jobs, const PoolCallbacks& callbacks) {
  std::vector<Slot> slots = make_slots(jobs);
  catch_interrupts();
  std::size_t next = 0, finished = 0;
  while (finished < count) {
    if (interrupted()) return false;
    std::vector<const Child*> running;
    bool news = false;
    for (Slot& slot : slots) {
      if (!slot.child && next < count) start(slot, next++, callbacks);
      if (!slot.child) continue;
      if (const auto outcome = slot.child->poll()) {
        slot.child.reset();
        ++finished;
        news = true;
        callbacks.done(slot.number, *outcome);
      } else {
        running.push_back(slot.child.get());
      }
    }
    if (callbacks.tick) callbacks.tick();
    if (!news) wait_for_news(running, callbacks.tick_s);
  }
  return true;
}

}  // namespace conebench::harness
