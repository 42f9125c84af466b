#include "solvers/monitor.h"

#include <algorithm>
#include <cmath>

#include "problems/residual.h"

namespace conebench::solvers {

Monitor::Monitor(const problems::Problem& standard, const Stop& stop)
    : problem_(standard), stop_(stop), start_(Clock::now()) {
  stop_.check();
}

void Monitor::setup_done() { setup_s_ = elapsed_s(); }

void Monitor::set_clock(double setup_s, double solve_s) {
  setup_s_ = setup_s;
  const std::chrono::duration<double> too_much(elapsed_s() - setup_s - solve_s);
  paused_ += std::chrono::duration_cast<Clock::duration>(too_much);
}

double Monitor::elapsed_s() const {
  return std::chrono::duration<double>(Clock::now() - start_ - paused_).count();
}

bool Monitor::look_is_due(std::int64_t iteration, double work_s) const {
  return iteration >= next_look_ || (work_s > 0.0 && work_s >= next_look_work_s_);
}

std::optional<Status> Monitor::limit(std::int64_t iteration) const {
  if (iteration >= stop_.max_iterations) return Status::kIterationLimit;
  if (elapsed_s() >= stop_.time_limit_s) return Status::kTimeLimit;
  return std::nullopt;
}

double Monitor::look(std::int64_t iteration, const Eigen::VectorXd& r, double work_s) {
  const auto pause = Clock::now();
  if (on_look_) on_look_(true);
  const double time_s = std::chrono::duration<double>(pause - start_ - paused_).count();
  const double eta = problems::evaluate_eta(problem_, r);
  curve_.push_back({time_s, iteration, eta});
  if (eta < best_eta_) {
    best_eta_ = eta;
    best_ = r;
  }
  const double growth = 1.0 + stop_.look_growth;
  next_look_ = std::max(
      iteration + 1, static_cast<std::int64_t>(std::ceil(growth * static_cast<double>(iteration))));
  next_look_work_s_ = growth * work_s;
  if (on_look_) on_look_(false);
  paused_ += Clock::now() - pause;
  return eta;
}

Verdict Monitor::check(std::int64_t iteration, const std::function<const Eigen::VectorXd&()>& r,
                       double work_s) {
  const std::optional<Status> reached = limit(iteration);
  if (stop_.test == StopTest::kCommon && (reached || look_is_due(iteration, work_s))) {
    const double eta = look(iteration, r(), work_s);
    // The residual comes first: an answer that is good enough at the limit has converged.
    if (eta <= stop_.tol) {
      status_ = Status::kConverged;
      return Verdict::kStop;
    }
    if (!std::isfinite(eta)) {
      status_ = Status::kDiverged;
      return Verdict::kStop;
    }
  }
  if (!reached) return Verdict::kGoOn;
  status_ = *reached;
  return Verdict::kStop;
}

Status Monitor::conclude(Status why, std::int64_t iteration, const Eigen::VectorXd& r) {
  status_ = why;
  if (stop_.test == StopTest::kCommon && look(iteration, r, 0.0) <= stop_.tol) {
    status_ = Status::kConverged;
  }
  return status_;
}

}  // namespace conebench::solvers
