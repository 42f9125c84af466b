#pragma once

#include <cmath>
#include <tuple>
#include <utility>

#include "problems/cone.h"

namespace conebench::solvers {

/// a, b >= 0 with a b = 0 -> a, b > 0 with a b = nu and the same lambda a - b.
inline std::pair<double, double> central_numbers(double a, double b, double lambda, double nu) {
  const double difference = lambda * a - b;
  const double sum = std::hypot(difference, 2.0 * std::sqrt(lambda * nu));
  if (difference > 0.0) {
    const double larger = (sum + difference) / (2.0 * lambda);
    return {larger, nu / larger};
  }
  const double larger = 0.5 * (sum - difference);
  return {nu / larger, larger};
}

/// Complementary r in K_mu and x in K_mu* -> a pair on the central path of their cone, interior:
/// with rho = (sqrt(mu) r_n, r_t / sqrt(mu)) and xi = (x_n / sqrt(mu), sqrt(mu) x_t),
///
///   rho o xi = nu e   (o: the Jordan product of solvers/nt_scaling.h),
///
/// where lambda rho - xi has the eigenvectors that it had, and their eigenvalues: the smoothed
/// projections of Chen and Mangasarian's kind, in the cone's frame. mu = 0 is the half line: r_t
/// and x_t stay as they are.
///
/// lambda > 0, nu > 0. Source  Fukushima, Luo, Tseng, SIAM J. Optim. 12(2) (2002) (not checked).
inline void centre(double mu, double lambda, double nu, Eigen::Ref<Eigen::VectorXd> r,
                   Eigen::Ref<Eigen::VectorXd> x) {
  const Eigen::Index tangents = r.size() - 1;
  if (tangents == 0 || mu == 0.0) {
    std::tie(r(0), x(0)) = central_numbers(r(0), x(0), lambda, nu);
    return;
  }
  const double root = std::sqrt(mu);
  const double pull = problems::tangential_norm(r), slip = problems::tangential_norm(x);
  // The axis that both tangential parts lie on; its sense does not matter.
  Eigen::VectorXd along = Eigen::VectorXd::Unit(tangents, 0);
  if (lambda * pull > slip) {
    along = r.tail(tangents) / pull;
  } else if (slip > 0.0) {
    along = x.tail(tangents) / slip;
  }
  const double rho_n = root * r(0), rho_t = along.dot(r.tail(tangents)) / root;
  const double xi_n = x(0) / root, xi_t = root * along.dot(x.tail(tangents));
  const auto [rho_1, xi_1] = central_numbers(rho_n + rho_t, xi_n + xi_t, lambda, nu);
  const auto [rho_2, xi_2] = central_numbers(rho_n - rho_t, xi_n - xi_t, lambda, nu);
  r(0) = 0.5 * (rho_1 + rho_2) / root;
  r.tail(tangents) = 0.5 * (rho_1 - rho_2) * root * along;
  x(0) = 0.5 * (xi_1 + xi_2) * root;
  x.tail(tangents) = 0.5 * (xi_1 - xi_2) / root * along;
}

}  // namespace conebench::solvers
