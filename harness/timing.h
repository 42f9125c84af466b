#pragma once

#include <cstdint>
#include <vector>

#include "solvers/monitor.h"
#include "solvers/solver.h"

namespace conebench::harness {

/// How often a solve is repeated for its time.
struct Repeats {
  bool by_confidence = false;  ///< otherwise once, and that one counts
  double spread_goal = 0.02;   ///< of TimedSolves::spread [-], > 0
  std::int64_t most = 200;     ///< samples at most; a sample is one solve, or a batch of short ones
  double budget_s = 1.0;       ///< wall clock of all solves together, residuals included

  void check() const;  ///< throws InputError
};

/// A solve and what it costs. Times are those of the solver's own clock, in which the residuals of
/// StopTest::kCommon do not count.
struct TimedSolves {
  solvers::Result result;                  ///< of the first solve, whatever follows
  std::vector<solvers::CurvePoint> curve;  ///< likewise, its times in proportion to the medians
  double setup_s = 0.0, solve_s = 0.0;     ///< medians, each of a solve
  double cpu_s = 0.0;       ///< median of a solve's processor time, set-up included, residuals not;
                            ///< all threads, and the processes that it has waited for
  std::int64_t solves = 1;  ///< that the medians are made of
  double spread = 0.0;  ///< of setup_s + solve_s: MedianInterval::spread(); infinite if not known
  std::uint64_t allocations = 0;   ///< calls for memory in the first solve: AllocationCount
  std::uint64_t memory_bytes = 0;  ///< growth of the resident peak in the first solve: MemoryGrowth
  std::uint64_t process_peak_bytes = 0;  ///< of this process so far; see MemoryGrowth
};

/// Solves once, or until the median time is known to the goal. By confidence the first solve warms
/// up and its time does not count, unless there is no time for a second: a solve that takes more
/// than half of the budget is not done twice. Then Google Benchmark repeats it (with the solver's
/// clock as manual time), in batches of at least kSample_s so that the clock's resolution does not
/// matter, until the goal, the count or the budget is reached; one batch is one sample.
/// A repeat that returns another r than the first solve adds one note to Result::notes, unless the
/// time limit ended one of the two.
///
/// Precondition: no Google benchmark of this process is running; those registered are forgotten.
/// Errors  whatever the solver throws.
TimedSolves time_solves(const solvers::Solver& solver, const problems::Problem& standard,
                        const Eigen::VectorXd& guess, const solvers::Stop& stop,
                        const Repeats& repeats);

/// Solver time of a batch [s]: 20,000 times the resolution of a clock of 50 ns.
inline constexpr double kSample_s = 1e-3;

}  // namespace conebench::harness
