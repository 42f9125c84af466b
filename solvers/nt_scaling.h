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
/// Scaled directions: dr~ = N drho, dx~ = N^-1 dxi. Jordan product a o b = (a.b, a_0 b_t + b_0
/// a_t). Source  Vandenberghe, "The CVXOPT linear and quadratic cone program solvers" (2010),
/// section 4
///         (not checked); Alizadeh & Goldfarb, Math. Program. 95 (2003) (not checked).
class NtScaling {
 public:
  /// Precondition: r and x strictly inside. Sizes d.
  void set(double mu, const Eigen::VectorXd& r, const Eigen::VectorXd& x);

  /// Components that take part: d, or 1.
  Eigen::Index size() const { return lambda_.size(); }
  const Eigen::VectorXd& lambda() const { return lambda_; }

  /// Z (d x d) with dx + Z dr = ...: T^-1 N^2 T^-T. For a half line only Z(0, 0) counts; the rest
  /// of the diagonal is `huge`, which holds r_t at 0.
  void write_Z(double huge, Eigen::Ref<Eigen::MatrixXd> Z) const;

  Eigen::VectorXd scaled_r(const Eigen::VectorXd& dr) const;        ///< N T^-T dr
  Eigen::VectorXd scaled_x(const Eigen::VectorXd& dx) const;        ///< N^-1 T dx
  Eigen::VectorXd unscaled_x(const Eigen::VectorXd& scaled) const;  ///< T^-1 N scaled, d entries

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
