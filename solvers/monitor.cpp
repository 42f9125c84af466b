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

double Monitor::elapsed_s() const {
  return std::chrono::duration<double>(Clock::now() - start_ - paused_).count();
}

bool Monitor::due(std::int64_t iteration) const {
  return (stop_.test == StopTest::kCommon && iteration >= next_look_) ||
         limit(iteration).has_value();
}

std::optional<Status> Monitor::limit(std::int64_t iteration) const {
  if (iteration >= stop_.max_iterations) return Status::kIterationLimit;
  if (elapsed_s() >= stop_.time_limit_s) return Status::kTimeLimit;
  return std::nullopt;
}

double Monitor::look(std::int64_t iteration, const Eigen::VectorXd& r) {
  const auto pause = Clock::now();
  const double time_s = std::chrono::duration<double>(pause - start_ - paused_).count();
  const double eta = problems::evaluate_eta(problem_, r);
  curve_.push_back({time_s, iteration, eta});
  if (eta < best_eta_) {
    best_eta_ = eta;
    best_ = r;
  }
  next_look_ = std::max(
      iteration + 1, static_cast<std::int64_t>(std::ceil(1.02 * static_cast<double>(iteration))));
  paused_ += Clock::now() - pause;
  return eta;
}

Verdict Monitor::check(std::int64_t iteration, const Eigen::VectorXd& r) {
  const std::optional<Status> reached = limit(iteration);
  if (stop_.test == StopTest::kCommon && (reached || iteration >= next_look_)) {
    const double eta = look(iteration, r);
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
  if (stop_.test == StopTest::kCommon && look(iteration, r) <= stop_.tol) {
    status_ = Status::kConverged;
  }
  return status_;
}

}  // namespace conebench::solvers
