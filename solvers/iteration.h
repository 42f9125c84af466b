#pragma once

#include <memory>

#include "solvers/method.h"

namespace conebench::solvers {

/// A method as a sequence of steps: one loop (drive) runs them all, and `auto` can leave one for
/// another and come back.
class Iteration {
 public:
  enum class State {
    kRunning,
    kStalled,     ///< further steps will not change r
    kDiverged,    ///< a step gave no finite answer; r() is the last finite one
    kInfeasible,  ///< proved that there is no solution; certificate() says why
  };

  virtual ~Iteration() = default;

  /// Starts anew from `r` (rows() entries, finite). What was factorised and analysed for
  /// good is kept.
  virtual void start(const Eigen::VectorXd& r) = 0;
  /// One iteration of the method's outermost natural loop.
  virtual State advance() = 0;
  /// May have to write it first: it is asked for when eta is looked at, not in every iteration.
  virtual const Eigen::VectorXd& r() const = 0;
  /// The method's own estimate of eta at r(); infinity while it has none. It steers, and is
  /// verified; a lower estimate than the truth costs time, never correctness.
  virtual double own_eta() const = 0;
  /// Arithmetic since construction, in seconds of a nominal core: the same on every machine and in
  /// every run, within a factor of about 3 of the time it takes. 0 where nobody counts it.
  virtual double work_s() const { return 0.0; }
  /// What a reader of the table should know of this run.
  virtual std::vector<std::string> notes() const { return {}; }
  /// y of kInfeasible (solvers/certificate.h); empty otherwise.
  virtual Eigen::VectorXd certificate() const { return {}; }
};

using MakeIteration = std::function<std::unique_ptr<Iteration>(const problems::Problem&)>;

/// Runs an iteration from `guess` until the monitor, the own test or the iteration itself says
/// stop. With StopTest::kOwn an estimate below the tolerance is verified with eta itself, inside
/// the clock, at most every 10 % of further iterations; an answer that has not converged is the
/// last iterate, or one whose own eta is within a tenth of the best there was, where that is
/// better.
Result drive(Iteration& iteration, const problems::Problem& problem, const Stop& stop,
             const Eigen::VectorXd& guess, Monitor& monitor);

/// A solver from a method whose every solve makes an iteration and drives it.
Solver make_iterative_solver(const Method& method, const Values& values, Refuses refuses,
                             MakeIteration make);

}  // namespace conebench::solvers
