#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "harness/mode.h"
#include "harness/pool.h"
#include "harness/problem_id.h"
#include "harness/shared.h"
#include "results/record.h"
#include "solvers/solver.h"

namespace conebench::harness {

/// One solver, once, on one problem or on a sequence of them, in a worker process of its own.
struct Task {
  /// One; with Mode::kSequence consecutive steps of a scene. Of their ids the worker fills in what
  /// is empty. kappa is shifted away in the worker.
  SharedList<ProblemSource> problems;
  Shared<solvers::Solver> solver;
  solvers::Stop stop{};  ///< of each problem
  Mode mode = Mode::kCold;
  /// Of a sequence: whose answers, from its own sequence, are the guesses; nothing: the solver's.
  std::optional<Shared<solvers::Solver>> donor{};
  int threads = 1;                       ///< of the libraries that the solver calls
  std::uint64_t memory_limit_bytes = 0;  ///< of the worker's address space; 0: none
  /// Wall clock of a problem, loading and judging included; default_hard_limit_s() else. At it the
  /// worker is asked to end (SIGTERM), a second later it is killed.
  std::optional<double> hard_limit_s{};
  int repetition = 0;
  bool repeat_for_confidence = false;  ///< time many solves of a short task (harness/timing.h)
  std::optional<std::filesystem::path> solution_file{};  ///< where to write /solution, of one
};

/// When a worker that does not stop by itself is killed: twice the solver's time limit, because
/// the residuals of StopTest::kCommon are outside its clock, and 30 s to load and to judge.
double default_hard_limit_s(double time_limit_s);

/// The records of a task before anything ran, one a problem: what, with which settings, where.
std::vector<results::Record> blank_records(const Task& task);

/// The task as a job for a child process, and the records of how that ended, one a problem. The
/// verdict is the worker's: r' is judged by problems::evaluate_residual after the solve, outside
/// the clock. A worker that dies leaves no answer to any problem of its sequence.
/// records_of() throws InputError when a problem could not be loaded, OutputError when the solution
/// could not be written.
Job job_of(const Task& task);
std::vector<results::Record> records_of(const Task& task, const ChildOutcome& outcome);

/// Both together, for a task of one problem. Nothing when interrupted.
std::optional<results::Record> run_task(const Task& task);

}  // namespace conebench::harness
