#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "harness/child.h"

namespace conebench::harness {

/// One piece of work for a child process.
struct Job {
  std::function<std::string()> work;
  ChildLimits limits;
};

/// What run_pool() calls, always in this process.
struct PoolCallbacks {
  std::function<Job(std::size_t)> make;  ///< the job of that number, when its turn comes
  std::function<void(std::size_t, const ChildOutcome&)> done;
  std::function<void()> tick;  ///< at least every tick_s, unless a callback takes longer
  double tick_s = 0.1;
};

/// Does `count` jobs in child processes, at most `jobs` at a time, started in order. With more than
/// one at a time each is bound to a core of its own. False when interrupted (harness/interrupt.h):
/// running children are killed and never reported. An exception from a callback ends it likewise.
bool run_pool(std::size_t count, int jobs, const PoolCallbacks& callbacks);

/// The cores that this process may use.
std::vector<int> allowed_cores();

}  // namespace conebench::harness
