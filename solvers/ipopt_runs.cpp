#include "solvers/ipopt_runs.h"

#include <algorithm>
#include <cmath>

#include "solvers/dimensionless.h"

namespace conebench::solvers {
namespace {

// Of a first run. Below the least, rounding decides; each run after one that was not good enough
// asks for a hundredth.
constexpr double kLargestGap = 1e-2, kSmallGap = 1e-14, kLeastGap = 1e-20, kNextGap = 1e-2;
constexpr int kRestarts = 2;

}  // namespace

void IpoptRuns::aim_at(double tolerance) {
  const double wanted = std::pow(Dimensionless::kRateScale * tolerance, 2.0);
  next_.tol = std::min(next_.tol, std::clamp(wanted, kSmallGap, kLargestGap));
}

bool IpoptRuns::over() const { return failures_ > kRestarts || next_.tol < kLeastGap; }

IpoptEnd IpoptRuns::run(const ConeProgram& program, ProgramPoint& point, const Watch& watch) {
  const IpoptEnd end = run_ipopt(program, next_, point, watch);
  if (end == IpoptEnd::kSolved) {
    next_.barrier = next_.tol;
    next_.tol *= kNextGap;
  } else {
    ++failures_;
    next_.barrier = IpoptRun{}.barrier;
    point = {std::move(point.x)};
  }
  return end;
}

}  // namespace conebench::solvers
