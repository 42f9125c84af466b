#include "solvers/convex.h"

#include <algorithm>
#include <cmath>

namespace conebench::solvers {

Eigen::VectorXd de_saxce_shift(const problems::Problem& problem, const Eigen::VectorXd& u) {
  Eigen::VectorXd shift(problem.cone_count());
  for (int i = 0; i < problem.cone_count(); ++i) {
    const problems::Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    shift(i) = cone.theta * u.segment(problem.start(i) + 1, cone.dim - 1).norm();
  }
  return shift;
}

double convex_error(const problems::Problem& problem, const Eigen::VectorXd& shift,
                    const Eigen::VectorXd& r, const Eigen::VectorXd& u) {
  double worst = 0.0;
  Eigen::VectorXd z;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const problems::Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    const int at = problem.start(i);
    const double lambda = problem.mobility()(i);
    z = r.segment(at, cone.dim) - u.segment(at, cone.dim) / lambda;
    z(0) -= shift(i) / lambda;
    problems::project(cone.mu, z);
    const double error = lambda * (r.segment(at, cone.dim) - z).norm();
    if (std::isnan(error)) return error;
    worst = std::max(worst, error);
  }
  return problem.rate_scale() > 0.0 ? worst / problem.rate_scale() : worst;
}

}  // namespace conebench::solvers
