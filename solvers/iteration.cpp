#include "solvers/iteration.h"

#include "problems/residual.h"

namespace conebench::solvers {

using problems::Problem;

namespace {
// An iterate is kept where its own eta is below this share of the last one kept: to copy every
// slightly better one would cost a tenth of a sweep, more where several threads share it.
constexpr double kBetter = 0.9;
}  // namespace

Result drive(Iteration& iteration, const Problem& problem, const Stop& stop,
             const Eigen::VectorXd& guess, Monitor& monitor) {
  iteration.start(guess);
  monitor.setup_done();

  Result result;
  // With kCommon the monitor keeps the best iterate; with kOwn nobody else does.
  Eigen::VectorXd best = iteration.r();
  double own_eta = iteration.own_eta(), best_eta = own_eta;
  std::int64_t next_verification = 0;
  const auto iterate = [&]() -> const Eigen::VectorXd& { return iteration.r(); };
  auto verified = [&] {
    return stop.test == StopTest::kOwn &&
           problems::evaluate_eta(problem, iteration.r()) <= stop.tol;
  };
  while (true) {
    if (stop.test == StopTest::kOwn && own_eta <= stop.tol &&
        result.iterations >= next_verification) {
      if (verified()) {
        result.status = Status::kConverged;
        break;
      }
      next_verification = result.iterations + 1 + result.iterations / 10;
    }
    if (monitor.check(result.iterations, iterate, iteration.work_s()) == Verdict::kStop) {
      result.status = monitor.status();
      break;
    }
    const Iteration::State state = iteration.advance();
    ++result.iterations;
    if (stop.test == StopTest::kOwn) {
      own_eta = iteration.own_eta();
      if (own_eta < kBetter * best_eta) {
        best = iteration.r();
        best_eta = own_eta;
      }
    }
    if (state == Iteration::State::kRunning) continue;
    if (state == Iteration::State::kInfeasible) {
      result.status = Status::kInfeasible;
      result.certificate = iteration.certificate();
      break;
    }
    const Status why = state == Iteration::State::kStalled ? Status::kStalled : Status::kDiverged;
    result.status =
        monitor.conclude(verified() ? Status::kConverged : why, result.iterations, iteration.r());
    break;
  }
  result.r = iteration.r();
  if (result.status != Status::kConverged && stop.test == StopTest::kOwn &&
      problems::evaluate_eta(problem, best) < problems::evaluate_eta(problem, result.r)) {
    result.r = best;
  }
  result.notes = iteration.notes();
  return result;
}

Solver make_iterative_solver(const Method& method, const Values& values, Refuses refuses,
                             MakeIteration make) {
  auto run = [make = std::move(make)](const Problem& problem, const Stop& stop,
                                      const Eigen::VectorXd& guess, Monitor& monitor) {
    const std::unique_ptr<Iteration> iteration = make(problem);
    return drive(*iteration, problem, stop, guess, monitor);
  };
  return make_checked_solver(method, values, std::move(refuses), std::move(run));
}

}  // namespace conebench::solvers
