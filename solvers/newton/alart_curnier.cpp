#include "solvers/newton/alart_curnier.h"

#include <algorithm>

namespace conebench::solvers {

using problems::Cone;

double AlartCurnier::trial_normal(const Cone& cone, const ConstPart& p, const ConstPart& u) const {
  return p(0) - rho_ * (u(0) - (cone.mu - cone.theta) * problems::tangential_norm(u));
}

double AlartCurnier::disk_radius(double mu, double p_n, double z_n) const {
  return mu * std::max(0.0, radius_ == Radius::kAlartCurnier ? z_n : p_n);
}

void AlartCurnier::value(const Cone& cone, const ConstPart& p, const ConstPart& u, Part phi) const {
  const Eigen::Index tangents = p.size() - 1;
  const double z_n = trial_normal(cone, p, u), radius = disk_radius(cone.mu, p(0), z_n);
  phi(0) = p(0) - std::max(0.0, z_n);
  auto phi_t = phi.tail(tangents);
  phi_t = p.tail(tangents) - rho_ * u.tail(tangents);
  const double norm = phi_t.norm();
  if (norm > radius) phi_t *= radius / norm;
  phi_t = p.tail(tangents) - phi_t;
}

void AlartCurnier::jacobian(const Cone& cone, const ConstPart& p, const ConstPart& u, PartMatrix dp,
                            PartMatrix du) const {
  const Eigen::Index tangents = p.size() - 1;
  const double z_n = trial_normal(cone, p, u), radius = disk_radius(cone.mu, p(0), z_n);
  const Eigen::VectorXd z_t = p.tail(tangents) - rho_ * u.tail(tangents);
  const double norm = z_t.norm(), rate = problems::tangential_norm(u);
  const double dilation = rate > 0.0 ? (cone.mu - cone.theta) / rate : 0.0;

  dp.setZero();
  du.setZero();
  if (z_n > 0.0) {
    du(0, 0) = rho_;
    du.row(0).tail(tangents) = -rho_ * dilation * u.tail(tangents).transpose();
  } else {
    dp(0, 0) = 1.0;
  }
  auto dp_tt = dp.bottomRightCorner(tangents, tangents);
  auto du_tt = du.bottomRightCorner(tangents, tangents);
  if (!(radius > 0.0)) {
    dp_tt.setIdentity();
    return;
  }
  if (norm <= radius) {
    du_tt.diagonal().setConstant(rho_);
    return;
  }
  // phi_t = p_t - R e with e = z_t / |z_t|.
  const Eigen::VectorXd e = z_t / norm;
  du_tt.noalias() = -rho_ * radius / norm * e * e.transpose();
  du_tt.diagonal().array() += rho_ * radius / norm;
  dp_tt = -du_tt / rho_;
  dp_tt.diagonal().array() += 1.0;
  dp.col(0).tail(tangents) = -cone.mu * e;
  if (radius_ == Radius::kAlartCurnier) {
    du.col(0).tail(tangents) = rho_ * cone.mu * e;
    du_tt.noalias() -= rho_ * cone.mu * dilation * e * u.tail(tangents).transpose();
  }
}

}  // namespace conebench::solvers
