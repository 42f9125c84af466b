#pragma once

#include <Eigen/Core>

namespace conebench::solvers {

/// Nesterov-Todd scaling of one second-order cone, in closed form.
///
/// A pair r in int K_mu, x in int K_mu* is first made symmetric,
///   rho = (sqrt(mu) r_n, r_t / sqrt(mu)),   xi = (x_n / sqrt(mu), sqrt(mu) x_t),   rho.xi = r.x,
/// both in the Lorentz cone L. N is the symmetric matrix with N rho = N^-1 xi = lambda. d = 1 and
/// mu = 0 are the half line (r_t = 0, x_t free): only component 0 takes part.
///
/// Scaled directions: dr~ = N drho, dx~ = N^-1 dxi.
/// Jordan product: a o b = (a.b, a_0 b_t + b_0 a_t).
/// Source  Vandenberghe, "The CVXOPT linear and quadratic cone program solvers" (2010), section 4
///         (not checked); Alizadeh & Goldfarb, Math. Program. 95 (2003) (not checked).
class NtScaling {
 public:
  /// Precondition: r and x strictly inside. Sizes d.
  void set(double mu, const Eigen::VectorXd& r, const Eigen::VectorXd& x);

  /// Components that take part: d, or 1.
  Eigen::Index size() const { return lambda_.size(); }
  const Eigen::VectorXd& lambda() const { return lambda_; }

  /// R = N^-1 T (d x d; of a half line only R(0, 0) is not zero): dx~ = R dx, dr = R^T dr~.
  void write_R(Eigen::Ref<Eigen::MatrixXd> R) const;

 private:
  Eigen::VectorXd apply(const Eigen::VectorXd& a, bool inverse) const;  // N a or N^-1 a

  Eigen::Index dim_ = 0;
  Eigen::VectorXd diagonal_;  // of T: xi = T x, rho = T^-1 r
  Eigen::VectorXd v_;         // N = eta (2 v v^T - J)
  double eta_ = 1.0;
  Eigen::VectorXd lambda_;
};

/// a o b, a^-1 o b, and the longest step s <= `longest` with a + s d in L.
Eigen::VectorXd jordan_product(const Eigen::VectorXd& a, const Eigen::VectorXd& b);
Eigen::VectorXd jordan_divide(const Eigen::VectorXd& a, const Eigen::VectorXd& b);
double longest_step(const Eigen::VectorXd& a, const Eigen::VectorXd& d, double longest);

}  // namespace conebench::solvers
