#pragma once

#include <Eigen/Core>
#include <cmath>

namespace conebench::problems {

/// One contact (or stress node): its cone and its law.
///
/// Coulomb-Signorini with cohesion: r + kappa e_n lies in K_mu = { |x_t| <= mu x_n, x_n >= 0 },
/// u + theta |u_t| e_n in the dual cone, and the two are orthogonal. Component 0 is normal.
struct Cone {
  int dim = 3;         ///< number of components, >= 1; 1 is a frictionless contact
  double mu = 0.0;     ///< friction coefficient [-], >= 0
  double kappa = 0.0;  ///< tensile strength [force_unit], >= 0: the cone's tip is at -kappa e_n
  double theta = 0.0;  ///< flow coefficient [-], 0 <= theta <= mu; mu = Coulomb, 0 = associated

  static Cone coulomb(int dim, double mu, double kappa = 0.0) { return {dim, mu, kappa, mu}; }
  static Cone associated(int dim, double mu, double kappa = 0.0) { return {dim, mu, kappa, 0.0}; }
};

/// Euclidean norm of the tangential part x_t; 0 for d = 1.
template <class Vector>
[[gnu::always_inline]] inline double tangential_norm(const Eigen::MatrixBase<Vector>& x) {
  double square = 0.0;
  for (Eigen::Index k = 1; k < x.size(); ++k) square += x(k) * x(k);
  return std::sqrt(square);
}

/// Replaces x by its Euclidean projection on K_mu. Exact for mu = 0, where K is the half line
/// x_n >= 0, x_t = 0, and for d = 1.
template <class Vector>
[[gnu::always_inline]] inline void project(double mu, Eigen::MatrixBase<Vector>& x) {
  const double normal = x(0);
  const double tangential = tangential_norm(x);
  if (tangential <= mu * normal && normal >= 0.0) return;
  if (mu * tangential <= -normal) {
    x.setZero();
    return;
  }
  const double scale = (normal + mu * tangential) / (1.0 + mu * mu);
  x(0) = scale;
  if (!(tangential > 0.0)) return;
  const double shrinkage = mu * scale / tangential;
  for (Eigen::Index k = 1; k < x.size(); ++k) x(k) *= shrinkage;
}

/// De Saxce's change of variable, in place: u becomes u + theta |u_t| e_n.
template <class Vector>
void add_de_saxce(double theta, Eigen::MatrixBase<Vector>& u) {
  u(0) += theta * tangential_norm(u);
}

}  // namespace conebench::problems
