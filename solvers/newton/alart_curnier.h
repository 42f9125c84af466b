#pragma once

#include "solvers/newton/cone_function.h"

namespace conebench::solvers {

/// The function of Alart and Curnier, with y = u_n - (mu - theta)|u_t| in the place of u_n:
///
///   z_n = p_n - rho y,   z_t = p_t - rho u_t,
///   phi_n = p_n - [z_n]_+,   phi_t = p_t - P_D(R)(z_t),   |P_D(R)(z_t)| <= R,
///
/// R = mu [z_n]_+ (Alart-Curnier) or mu [p_n]_+ (Jean-Moreau). In r this is the step rho / lambda.
///
/// Kinks  [.]_+ has slope 0 at 0 (open); a z_t on the disk's edge counts as inside (stick); |u_t|
/// has gradient 0 at 0. Each is an element of Clarke's generalised Jacobian of its own part.
/// Source  Acary, Bremond, Huber, RR-9118 (2017) (not checked); theta < mu: formulation.
class AlartCurnier final : public ConeFunction {
 public:
  enum class Radius { kAlartCurnier, kJeanMoreau };

  /// rho > 0 [-]
  AlartCurnier(Radius radius, double rho) : radius_(radius), rho_(rho) {}

  void value(const problems::Cone& cone, const ConstPart& p, const ConstPart& u,
             Part phi) const override;
  void jacobian(const problems::Cone& cone, const ConstPart& p, const ConstPart& u, PartMatrix dp,
                PartMatrix du) const override;

 private:
  double trial_normal(const problems::Cone& cone, const ConstPart& p, const ConstPart& u) const;
  double disk_radius(double mu, double p_n, double z_n) const;

  Radius radius_;
  double rho_;
};

}  // namespace conebench::solvers
