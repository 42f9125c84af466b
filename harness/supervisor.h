#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "harness/child.h"

namespace conebench::harness {

/// What a supervisor says of its worker: plain bytes, written to a pipe in one piece.
struct SupervisorReport {
  int error = 0;   ///< an errno: the worker could not be started or not be cleared away
  int status = 0;  ///< of waitpid()
  bool timed_out = false, out_of_memory = false;
  double wall_s = 0.0, cpu_s = 0.0;
  std::uint64_t peak_memory_bytes = 0;
};

/// The ends of the pipes that a supervisor and its worker write to.
struct SupervisorFiles {
  int output = -1, errors = -1;  ///< the worker's
  int report = -1;               ///< of one SupervisorReport; closed without one if killed
};

/// The life of the process between a Child and its worker. It is the subreaper of the worker, so
/// that descendants whose parents are gone become its own children, in whatever session or group
/// they are; it keeps the limits on the wall clock, and in the end it kills and reaps children
/// until it has none. It kills nothing but its own children that it has not yet reaped: no process
/// of anybody else can have such a number. It does the same when SIGTERM tells it to stop, or when
/// `parent` ends, however that came about.
///
/// Precondition: all signals are blocked.
/// Cost  a second fork a task (harness/microbench/task_benchmark.cpp).
[[noreturn]] void supervise(const std::function<std::string()>& work, const ChildLimits& limits,
                            const SupervisorFiles& files, pid_t parent,
                            std::chrono::steady_clock::time_point start);

}  // namespace conebench::harness
