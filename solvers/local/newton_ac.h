#pragma once

#include "solvers/local/newton.h"

namespace conebench::solvers {

/// The equation of Alart and Curnier: with u = W r + q and g = u_n - (mu - theta)|u_t|,
///
///   F_n = r_n - [r_n - rho_n g]_+,   F_t = r_t - P_B(r_t - rho_t u_t),
///
/// B the ball of radius mu [r_n - rho_n g]_+, rho_n = 1 / W_nn, rho_t = 1 / tr W_tt. For theta = mu
/// this is the equation of Alart and Curnier; for theta < mu it has the same solutions as the law,
/// since sliding then means g = 0.
/// F is in units of r and is its own miss.
/// Generalised Jacobian at the kinks: of [.]_+ the zero, of P_B the identity, of |u_t| the zero.
///
/// Source  Alart, Curnier, CMAME 92 (1991) 353-375 (not checked).
template <int D>
class AlartCurnierCone {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;

  void set(const LocalProblem<D>& problem);
  void evaluate(const LocalProblem<D>& problem, const Vector& u, const Vector& r,
                NewtonPoint<D>& point) const;
  double squared_miss(const LocalProblem<D>& problem, const Vector& u, const Vector& r,
                      const NewtonPoint<D>& point) const;

 private:
  double rho_n_ = 1.0, rho_t_ = 1.0;
};

template <int D>
using NewtonAcLocal = NewtonLocal<D, AlartCurnierCone<D>>;

extern template class NewtonLocal<2, AlartCurnierCone<2>>;
extern template class NewtonLocal<3, AlartCurnierCone<3>>;
extern template class NewtonLocal<6, AlartCurnierCone<6>>;
extern template class NewtonLocal<Eigen::Dynamic, AlartCurnierCone<Eigen::Dynamic>>;

}  // namespace conebench::solvers
