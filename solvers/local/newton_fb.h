#pragma once

#include "solvers/local/newton.h"

namespace conebench::solvers {

/// The Fischer-Burmeister function of the second-order cone: with u = W r + q,
///
///   F(r) = x + y - (x o x + y o y)^{1/2} = 0,
///   x = s (mu r_n, r_t),   y = ((u_n + theta |u_t|) / mu, u_t) / s,
///
/// in the Jordan algebra of the second-order cone: F = 0 says that x and y lie in the self-dual
/// cone K_1 and are orthogonal. s^2 = sqrt(W_nn tr W_tt / (d - 1)) / mu: the geometric mean of the
/// two scalings that would let x and y change alike with r_n and with r_t. Without the 1 / mu, one
/// of them dwarfs the other for small mu.
/// With z = (x o x + y o y)^{1/2} and L_a b = a o b, dF = dx + dy - L_z^{-1} (L_x dx + L_y dy).
/// At the kinks (z on the cone's surface) z's smaller eigenvalue is floored at 1e-15 of its larger
/// one, which is the derivative of a smoothed F and tends to an element of the generalised
/// Jacobian; at x = y = 0 it is dx + dy, and |u_t| has derivative 0 at u_t = 0.
/// The miss is the natural residual, |r - P_K(r - (u + theta |u_t| e_n) / lambda)|: |F| says little
/// of a cone that is narrow.
///
/// Source  Fukushima, Luo, Tseng, SIAM J. Optim. 12(2) (2002) 436-460 (not checked).
template <int D>
class FischerBurmeisterCone {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  void set(const LocalProblem<D>& problem);
  void evaluate(const LocalProblem<D>& problem, const Vector& u, const Vector& r,
                NewtonPoint<D>& point) const;
  double squared_miss(const LocalProblem<D>& problem, const Vector& u, const Vector& r,
                      const NewtonPoint<D>& point) const;

 private:
  double scale_ = 1.0;  // s
};

template <int D>
using NewtonFbLocal = NewtonLocal<D, FischerBurmeisterCone<D>>;

extern template class NewtonLocal<2, FischerBurmeisterCone<2>>;
extern template class NewtonLocal<3, FischerBurmeisterCone<3>>;
extern template class NewtonLocal<6, FischerBurmeisterCone<6>>;
extern template class NewtonLocal<Eigen::Dynamic, FischerBurmeisterCone<Eigen::Dynamic>>;

}  // namespace conebench::solvers
