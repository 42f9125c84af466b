#pragma once

#include <span>
#include <string>

#include "results/record.h"

namespace conebench::results {

/// The results in Google Benchmark's JSON format (1.7.1: context and benchmarks), so that its
/// compare.py reads them. A task that met its tolerance in time is a run of the benchmark
///
///   SOLVER/PROBLEM@first 8 digits of its
///   content/tol:1e-08[/mode:..][/threads:..][/stop:own][/timing:repeated]
///
/// real_time is the solver's time [ns], cpu_time its processor time, iterations the solves that
/// were timed; eta, solver_iterations, cones are counters. A failure has no time: it is a run named
/// after its status, ".../failed:killed_time", with error_occurred and without real_time, in a
/// member "failures" beside "benchmarks": compare.py wants a time of every benchmark, and never
/// takes a limit for one.
std::string gbench_report(std::span<const Record> records);

}  // namespace conebench::results
