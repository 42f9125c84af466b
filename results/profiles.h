#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/record.h"

namespace conebench::results {

/// Solver time until the verified tolerance `t` was met [s]: that of the first curve point with
/// eta <= t, or of the whole solve where there is no curve (the solver's own stopping test).
/// Infinite, never the time limit, unless the *returned* answer was verified to eta <= t and the
/// time is within the limit.
double time_to_tolerance(const Record& record, double t);

/// What is compared: the solver, and of a sequence with another donor "gs after ipm".
std::string contender(const std::string& solver, const std::string& donor);
inline std::string contender(const Record& record) {
  return contender(record.solver, record.donor);
}

/// Times to one tolerance, solver by solver on the same problems.
struct TimeTable {
  struct Row {
    ProblemId problem;
    std::vector<double> time_s;                 ///< one a solver; infinite: not solved, or not run
    std::vector<std::optional<Status>> status;  ///< of the last repetition; nothing: not run
  };
  double tol = 0.0;
  std::vector<std::string> solvers;  ///< contenders, in alphabetical order
  std::vector<Row> rows;             ///< sorted: see before()
};

/// What the repetitions of one task come to.
struct Outcome {
  double time_s = 0.0;  ///< their median (the slower middle one of an even number), in which a
                        ///< failure is infinite
  Status status = Status::kCrashed;  ///< of the last repetition
};

/// `repetitions`: at least one, in any order.
Outcome outcome_of(std::span<const Record* const> repetitions, double t);

TimeTable make_time_table(std::span<const Record> records, double t);

/// How rows are sorted: by family, name, content.
bool before(const TimeTable::Row& a, const TimeTable::Row& b);

/// The rows that every solver was run on: what was not run is neither a success nor a failure, so
/// that a comparison of all leaves it out. Everything below looks at these rows alone.
TimeTable comparable(const TimeTable& table);

/// Of each solver, the rows that it was not run on.
std::vector<int> not_run(const TimeTable& table);

/// The table without one solver. Of a comparable() table, at least as many rows are comparable.
TimeTable without_solver(const TimeTable& table, std::size_t solver);

/// A step of a performance profile: from this ratio on, this share of the problems is solved.
struct ProfileStep {
  double ratio = 1.0;  ///< time over the fastest solver's time on the problem, >= 1
  double share = 0.0;  ///< of all problems, in [0, 1]
};

/// Dolan and More, Math. Program. 91, 2002: for each solver the share of problems on which it was
/// within `ratio` of the fastest. A problem that nobody solves counts against everyone. Times are
/// floored at kShortestTime_s, below which a clock says nothing.
std::vector<std::vector<ProfileStep>> performance_profiles(const TimeTable& table);

inline constexpr double kShortestTime_s = 1e-6;

/// Mean over [0, log2(kLargestRatio)] of a profile as a function of log2(ratio), in [0, 1].
double profile_area(std::span<const ProfileStep> profile);

inline constexpr double kLargestRatio = 1024.0;

/// exp(mean(log(t + kMeanShift_s))) - kMeanShift_s; nothing for an empty list.
std::optional<double> shifted_geometric_mean(std::span<const double> times_s);

inline constexpr double kMeanShift_s = 1e-3;

/// One line of a ranking.
struct Rank {
  std::string solver;
  int solved = 0;
  int problems = 0;   ///< that every solver was run on
  int not_run = 0;    ///< problems that this solver was not run on; they count for nobody
  int fastest = 0;    ///< problems on which no solver was faster
  double area = 0.0;  ///< profile_area
  /// Over the problems that *every* solver with at least one success solves; nothing if none.
  std::optional<double> common_mean_s;
  int common = 0;  ///< how many problems that is
};

/// Best first: by the number of problems solved, then by the area under the performance profile.
/// Failures are counted, never averaged into a time. Profiles depend on who is compared, and so may
/// the order of two solvers on whether a third is there (Gould and Scott, ACM TOMS 43(2), 2016):
/// see rank_stability.h. Which neighbours are not told apart: see told_apart.h.
std::vector<Rank> rank(const TimeTable& table);

}  // namespace conebench::results
