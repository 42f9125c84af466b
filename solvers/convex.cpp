#include "solvers/convex.h"

#include <algorithm>
#include <cmath>

#include "solvers/with_dimension.h"

namespace conebench::solvers {

Eigen::VectorXd de_saxce_shift(const problems::Problem& problem, const Eigen::VectorXd& u) {
  Eigen::VectorXd shift(problem.cone_count());
  for (int i = 0; i < problem.cone_count(); ++i) {
    const problems::Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    shift(i) = cone.theta * problems::tangential_norm(u.segment(problem.start(i), cone.dim));
  }
  return shift;
}

double convex_error(const problems::Problem& problem, const Eigen::VectorXd& shift,
                    const Eigen::VectorXd& r, const Eigen::VectorXd& u) {
  double worst = 0.0;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const problems::Cone& cone = problem.cones()[static_cast<std::size_t>(i)];
    const int at = problem.start(i);
    const double lambda = problem.mobility()(i);
    const double error = with_dimension(cone.dim, [&]<int D>() {
      const auto part = r.segment<D>(at, cone.dim);
      Eigen::Matrix<double, D, 1> z = part - u.segment<D>(at, cone.dim) / lambda;
      z(0) -= shift(i) / lambda;
      problems::project(cone.mu, z);
      return lambda * (part - z).norm();
    });
    if (std::isnan(error)) return error;
    worst = std::max(worst, error);
  }
  return problem.rate_scale() > 0.0 ? worst / problem.rate_scale() : worst;
}

}  // namespace conebench::solvers
