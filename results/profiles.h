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

/// Times to one tolerance, solver by solver on the same problems.
struct TimeTable {
  struct Row {
    ProblemId problem;
    std::vector<double> time_s;                 ///< one a solver; infinite: not solved
    std::vector<std::optional<Status>> status;  ///< of the last repetition; nothing: not run
  };
  double tol = 0.0;
  std::vector<std::string> solvers;  ///< in alphabetical order
  std::vector<Row> rows;             ///< sorted by family, then name
};

/// Repetitions of a task count with their median (the slower middle one of an even number), in
/// which a failure is infinite.
TimeTable make_time_table(std::span<const Record> records, double t);

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
  int problems = 0;
  int fastest = 0;    ///< problems on which no solver was faster
  double area = 0.0;  ///< profile_area
  /// Over the problems that *every* solver with at least one success solves; nothing if none.
  std::optional<double> common_mean_s;
  int common = 0;  ///< how many problems that is
};

/// Best first: by the number of problems solved, then by the area under the performance profile.
/// Failures are counted, never averaged into a time.
std::vector<Rank> rank(const TimeTable& table);

}  // namespace conebench::results
