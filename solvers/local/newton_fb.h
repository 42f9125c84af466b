#pragma once

#include <Eigen/Core>

namespace conebench::solvers {

/// One cone by the semismooth Newton method on the Fischer-Burmeister function, any d >= 2: the
/// problem of ExactLocal as
///
///   F(r) = x + y - (x o x + y o y)^{1/2} = 0,
///   x = sqrt(lambda) (a r_n, b r_t),   y = ((u_n + theta |u_t|) / a, u_t / b) / sqrt(lambda),
///
/// a = max(mu, 1), b = max(1/mu, 1), of the same size in both whatever mu, in the Jordan algebra of
/// the second-order cone, u = W r + q: F = 0 says that x and y lie in the self-dual cone K_1 and
/// are orthogonal. With z = (x o x + y o y)^{1/2} and L_a b = a o b, dF = dx + dy - L_z^{-1} (L_x
/// dx + L_y dy). At the kinks (z on the cone's surface) z's smaller eigenvalue is floored at 1e-15
/// of its larger one, which is the derivative of a smoothed F and tends to an element of the
/// generalised Jacobian; at x = y = 0 it is dx + dy, and |u_t| has derivative 0 at u_t = 0.
///
/// Start, cost and guarantees are those of NewtonAcLocal.
/// Source  Fukushima, Luo, Tseng, SIAM J. Optim. 12(2) (2002) 436-460 (not checked).
template <int D>
class NewtonFbLocal {
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
};

extern template class NewtonFbLocal<2>;
extern template class NewtonFbLocal<3>;
extern template class NewtonFbLocal<6>;
extern template class NewtonFbLocal<Eigen::Dynamic>;

}  // namespace conebench::solvers
