#pragma once

#include <Eigen/Core>

namespace conebench::solvers {

/// One cone by the semismooth Newton method of Alart and Curnier, any d >= 2: the problem of
/// ExactLocal as F(r) = 0, with u = W r + q and g = u_n - (mu - theta)|u_t|,
///
///   F_n = r_n - [r_n - rho_n g]_+,   F_t = r_t - P_B(r_t - rho_t u_t),
///
/// B the ball of radius mu [r_n - rho_n g]_+, rho_n = 1 / W_nn, rho_t = 1 / tr W_tt. For theta = mu
/// this is the equation of Alart and Curnier; for theta < mu it has the same solutions as the law,
/// since sliding then means g = 0.
/// Generalised Jacobian at the kinks: of [.]_+ the zero, of P_B the identity, of |u_t| the zero.
///
/// solve() starts from r on entry and, if that fails, from the frictionless answer. No convergence
/// proof: the merit |F| can have local minima, and F's Jacobian can be singular.
/// Cost    one d x d factorisation a step. Allocates nothing for fixed D.
/// Source  Alart, Curnier, CMAME 92 (1991) 353-375 (not checked).
template <int D>
class NewtonAcLocal {
 public:
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;

  /// As ExactLocal::set.
  void set(const Matrix& W, double lambda, double mu, double theta);
  const Matrix& W() const { return W_; }

  /// Improves r. False if it is not a solution then: the best iterate.
  bool solve(const Vector& q, Vector& r) const;

 private:
  template <class Point>
  void evaluate(const Vector& q, const Vector& r, Point& point) const;

  Matrix W_;
  double lambda_ = 1.0, mu_ = 0.0, theta_ = 0.0;
  double rho_n_ = 1.0, rho_t_ = 1.0;
};

extern template class NewtonAcLocal<2>;
extern template class NewtonAcLocal<3>;
extern template class NewtonAcLocal<6>;
extern template class NewtonAcLocal<Eigen::Dynamic>;

}  // namespace conebench::solvers
