#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "solvers/solver.h"

namespace conebench::solvers {

enum class Verdict { kGoOn, kStop };

/// One point of a convergence curve.
struct CurvePoint {
  double time_s = 0.0;  ///< solver time, set-up included, residuals excluded
  std::int64_t iteration = 0;
  double eta = 0.0;
};

/// The stopwatch and referee of one solve.
///
/// A method calls check() with its iterate after every iteration (and once before the first).
/// With StopTest::kCommon, eta is computed while the clock stands still: every method stops on the
/// same test and none pays for it. To bound the cost of judging, eta is looked at when the
/// iteration count or the work has grown by Stop::look_growth since the last look (with 2 % every
/// iteration up to 50); the clock has no say in it, so that two runs stop at the same iterate.
/// With StopTest::kOwn only the limits are watched.
class Monitor {
 public:
  /// Starts the clock. `standard` must outlive the monitor.
  Monitor(const problems::Problem& standard, const Stop& stop);

  /// Ends the set-up phase; call it once, before the first iteration.
  void setup_done();

  /// For a solver that ran in a process of its own and timed itself: makes the clock show
  /// setup_s + solve_s, whatever starting and watching that process took.
  void set_clock(double setup_s, double solve_s);

  /// Calls `hook` with true before each look at eta and with false after it, while the clock stands
  /// still: for whoever measures more of a solve than its time.
  void on_look(std::function<void(bool begins)> hook) { on_look_ = std::move(hook); }

  /// `r` is asked for when eta is looked at; `work_s`: Iteration::work_s(), where iterations differ
  /// in cost.
  Verdict check(std::int64_t iteration, const std::function<const Eigen::VectorXd&()>& r,
                double work_s = 0.0);
  Verdict check(std::int64_t iteration, const Eigen::VectorXd& r) {
    return check(iteration, [&r]() -> const Eigen::VectorXd& { return r; });
  }

  /// For a method that stops for a reason of its own: looks at r once more (kCommon) and answers
  /// kConverged if it is good enough, else `why`.
  Status conclude(Status why, std::int64_t iteration, const Eigen::VectorXd& r);

  /// Solver time so far [s].
  double elapsed_s() const;
  double setup_s() const { return setup_s_; }

  /// The reason for the last kStop; kStalled until there is one.
  Status status() const { return status_; }
  /// The iterate of least eta looked at so far; empty if none was.
  const Eigen::VectorXd& best() const { return best_; }
  double best_eta() const { return best_eta_; }
  const std::vector<CurvePoint>& curve() const { return curve_; }

 private:
  using Clock = std::chrono::steady_clock;

  double look(std::int64_t iteration, const Eigen::VectorXd& r, double work_s);
  std::optional<Status> limit(std::int64_t iteration) const;
  bool look_is_due(std::int64_t iteration, double work_s) const;

  const problems::Problem& problem_;
  Stop stop_;
  Clock::time_point start_;
  Clock::duration paused_{};
  std::function<void(bool)> on_look_;
  double setup_s_ = 0.0;
  std::int64_t next_look_ = 0;
  double next_look_work_s_ = 0.0;
  Status status_ = Status::kStalled;
  Eigen::VectorXd best_;
  double best_eta_ = std::numeric_limits<double>::infinity();
  std::vector<CurvePoint> curve_;
};

}  // namespace conebench::solvers
