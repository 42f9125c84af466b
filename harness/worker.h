#pragma once

#include <filesystem>
#include <functional>
#include <optional>

#include "harness/pool.h"
#include "problems/problem.h"
#include "results/record.h"
#include "solvers/solver.h"

namespace conebench::harness {

/// One solver on one problem, once, in a worker process of its own.
struct Task {
  /// Name, hash, ... as the record shall carry them. What is empty the worker fills in.
  results::ProblemId problem;
  std::function<problems::Problem()> load;  ///< called in the worker; kappa is shifted away there
  solvers::Solver solver;
  solvers::Stop stop{};
  std::uint64_t memory_limit_bytes = 0;  ///< of the worker's address space; 0: none
  std::optional<double> hard_limit_s{};  ///< wall clock; default_hard_limit_s() unless given
  int repetition = 0;
  std::optional<std::filesystem::path> solution_file{};  ///< where to write /solution
};

/// When a worker that does not stop by itself is killed: twice the solver's time limit, because
/// the residuals of StopTest::kCommon are outside its clock, and 30 s to load and to judge.
double default_hard_limit_s(double time_limit_s);

/// The task's record before anything ran: problem, solver, settings, host.
results::Record blank_record(const Task& task);

/// The task as a job for a child process, and the record of how that ended. The verdict is the
/// worker's: r' is judged by problems::evaluate_residual after the solve, outside the clock.
/// record_of() throws InputError when the problem could not be loaded, OutputError when the
/// solution could not be written.
Job job_of(const Task& task);
results::Record record_of(const Task& task, const ChildOutcome& outcome);

/// Both together, for one task. Nothing when interrupted.
std::optional<results::Record> run_task(const Task& task);

}  // namespace conebench::harness
