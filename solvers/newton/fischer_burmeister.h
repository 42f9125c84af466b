#pragma once

#include "solvers/newton/cone_function.h"

namespace conebench::solvers {

/// The function of Fischer and Burmeister in the Jordan algebra of the second-order cone,
///
///   phi = x + y - c,   c = (x^2 + y^2)^(1/2),
///   x = (mu p_n, p_t) / m,   y = (u_hat_n / mu, u_t) m,   u_hat_n = u_n + theta |u_t|,
///
/// m = min(mu, 1), so that mu -> 0 tends to the scalar function of (p_n, u_n). In r: x and y scaled
/// by lambda^(1/2) and lambda^(-1/2), phi by lambda^(1/2). mu = 0 and d = 1 are that scalar
/// function, and phi_t = p_t.
///
/// With x^2 + y^2 = (s, v), e = v / |v|: eigenvalues l2 = s + |v| and, without cancellation,
/// l1 = s - |v| = |x_t - x_n e|^2 + |y_t - y_n e|^2. L_a being the product with a,
///
///   dphi/dx = I - L_c^-1 L_x,   dphi/dy = I - L_c^-1 L_y,
///
/// and L_c has eigenvalues l2^(1/2), l1^(1/2) on (1, +-e) and c_n on the rest.
///
/// Kinks  x = y = 0: dphi/dx = dphi/dy = (1 - 2^(-1/2)) I, the limit along x = y = (t, 0).
/// l1 = 0 < l2: L_x and L_y map into the complement of (1, -e), and the bounded part of
/// L_c^-1 L_x on (1, -e) is taken as 0, the mean of its limits from opposite sides. |u_t| has
/// gradient 0 at 0.
/// Source  Fukushima, Luo, Tseng, SIAM J. Optim. 12(2) (2002); Daviet, Bertails-Descoubes,
/// Boissieux, ACM TOG 30(6) (2011) (neither checked).
class FischerBurmeister final : public ConeFunction {
 public:
  void value(const problems::Cone& cone, const ConstPart& p, const ConstPart& u,
             Part phi) const override;
  void jacobian(const problems::Cone& cone, const ConstPart& p, const ConstPart& u, PartMatrix dp,
                PartMatrix du) const override;
};

}  // namespace conebench::solvers
