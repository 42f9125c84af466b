#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/record.h"

namespace conebench::results {

/// The eta that an engine would have in hands if it stopped the solver after `deadline_s` of solver
/// time: the best that the curve shows by then, but never better than the answer that was returned
/// and verified. Infinite before the first point. Without a curve: the returned answer's from the
/// end of the solve on, infinite before.
double eta_at(const Record& record, double deadline_s);

/// How a solver keeps a deadline.
struct DeadlineRow {
  std::string solver;
  std::size_t tasks = 0;
  std::size_t missed = 0;  ///< tasks whose eta at the deadline is above their tolerance
  double median_eta = 0.0, p90_eta = 0.0;  ///< held at the deadline; order statistics
  double miss_rate() const { return static_cast<double>(missed) / static_cast<double>(tasks); }
};

/// One row a solver, in alphabetical order, over the problems that all of them were run on.
std::vector<DeadlineRow> deadline_rows(std::span<const Record> records, double deadline_s);

/// 1 ms, 10 ms, 100 ms, 1 s: those below the time limit.
std::vector<double> usual_deadlines_s(double time_limit_s);

}  // namespace conebench::results
