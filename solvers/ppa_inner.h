#pragma once

#include <memory>

#include "solvers/newton/newton.h"

namespace conebench::solvers {

/// What solves the proximal steps of solvers/ppa.h.
class ProximalInner {
 public:
  virtual ~ProximalInner() = default;

  /// Poses the step with this centre and weight, and starts at the centre.
  virtual void pose(const Eigen::VectorXd& centre, double alpha) = 0;
  /// One iteration; false where it breaks down. r stays finite.
  virtual bool advance() = 0;
  virtual const Eigen::VectorXd& r() const = 0;
  virtual const Eigen::VectorXd& u() const = 0;  ///< W r + q
  /// Iteration::work_s of the latest advance().
  virtual double step_work_s() const = 0;
};

std::unique_ptr<ProximalInner> make_proximal_newton_inner(const problems::Problem& problem,
                                                          NewtonSettings::Function function);

/// Precondition: gauss_seidel_refuses(problem, {}) is nothing.
std::unique_ptr<ProximalInner> make_proximal_gauss_seidel(const problems::Problem& problem);

}  // namespace conebench::solvers
