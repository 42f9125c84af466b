#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "harness/trajectories.h"

namespace conebench::harness {

/// Values over seeds.
struct Sample {
  std::size_t count = 0;  ///< values there are
  double mean = 0.0;      ///< NaN of none
  double spread = 0.0;    ///< sample standard deviation; NaN of fewer than two
};
Sample sample_of(const std::vector<double>& values);  ///< leaves NaN out

/// One observable of one solver at one tolerance.
struct Finding {
  Sample value;
  Sample deviation;  ///< from the reference's run of the same seed
  /// Whether the mean deviation lies within the reference's spread over seeds (of the yardstick,
  /// see ObservableKind). Nothing where that cannot be said: no spread, no value for some seed, a
  /// failed run.
  std::optional<bool> within;
};

struct FindingsLine {
  std::string solver;
  double tol = 0.0;
  std::size_t failed = 0;  ///< runs that ended in numbers that are not finite
  std::array<Finding, kObservables> of;

  const Finding& operator[](Observable what) const { return of[static_cast<std::size_t>(what)]; }
};

/// What an ensemble of runs says.
struct Findings {
  std::string scene, engine;
  std::vector<std::string> solvers;
  std::vector<double> tolerances;  ///< loosest first
  std::vector<std::int64_t> seeds;
  bool seed_matters = true;
  FindingsLine reference;           ///< deviations are 0
  std::vector<FindingsLine> lines;  ///< solver by solver, loosest tolerance first

  /// The spread that a deviation of `what` is held against.
  double yardstick(Observable what) const;
  /// The loosest tolerance that is enough: at it and at every tighter one that was tried the
  /// deviation lies within the yardstick. Nothing when not even the tightest does.
  std::optional<double> enough(const std::string& solver, Observable what) const;
};

/// Precondition: `rows` are those of the plan, all of them.
Findings find(const TrajectoryPlan& plan, const std::vector<TrajectoryRow>& rows);

}  // namespace conebench::harness
