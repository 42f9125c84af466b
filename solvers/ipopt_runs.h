#pragma once

#include <limits>

#include "solvers/cone_program.h"

namespace conebench::solvers {

/// ConeProgram::eps for programs scaled by solvers/dimensionless.h: 1e-14 of U.
inline constexpr double kIpoptEps = 1e-12;

/// Runs of Ipopt on one program, scaled by solvers/dimensionless.h, to ever smaller tolerances:
/// each is started from the last; one that fails is started anew, twice, from where it ended.
///
/// Ipopt's tolerance is one on the gap r.u_hat of a cone, which at the cone's tip is the square of
/// its residual.
class IpoptRuns {
 public:
  /// `iterations`: of one run, at most.
  explicit IpoptRuns(int iterations)
      : next_{.tol = std::numeric_limits<double>::infinity(), .max_iterations = iterations} {}

  /// The next run is at least as tight as this tolerance on eta wants it.
  void aim_at(double tolerance);
  /// No further run would help.
  bool over() const;
  IpoptEnd run(const ConeProgram& program, ProgramPoint& point, const Watch& watch);

 private:
  IpoptRun next_;
  int failures_ = 0;
};

}  // namespace conebench::solvers
