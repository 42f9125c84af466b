#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "solvers/block_diagonal.h"

namespace conebench::solvers {

/// Nesterov-Todd scaling of second-order cones, in closed form.
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
class NtScalings {
 public:
  explicit NtScalings(const problems::Problem& problem);

  /// Precondition: r and x strictly inside.
  void set(const Eigen::VectorXd& r, const Eigen::VectorXd& x);

  /// Components of cone i that take part: d, or 1.
  int size(int i) const { return size_[static_cast<std::size_t>(i)]; }
  /// One entry a row; those of components that do not take part are 0.
  const Eigen::VectorXd& lambda() const { return lambda_; }

  /// R = N^-1 T (d x d; of a half line only R(0, 0) is not zero): dx~ = R dx, dr = R^T dr~.
  void write_R(BlockDiagonal& R) const;

 private:
  const problems::Problem& problem_;
  std::vector<int> size_;
  std::vector<double> root_mu_, eta_;  // xi = T x, T = diag(1 / root_mu, root_mu, ...)
  Eigen::VectorXd v_, lambda_;         // N = eta (2 v v^T - J)
};

/// a_0 b_0 - a_t.b_t.
template <class A, class B>
double lorentz_product(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<B>& b) {
  double product = a(0) * b(0);
  for (Eigen::Index k = 1; k < a.size(); ++k) product -= a(k) * b(k);
  return product;
}

/// a_0^2 - |a_t|^2 without cancellation between squares; >= a tiny positive number.
template <class Vector>
double lorentz_determinant(const Eigen::MatrixBase<Vector>& a) {
  const double tangential = problems::tangential_norm(a);
  return std::max((a(0) - tangential) * (a(0) + tangential), std::numeric_limits<double>::min());
}

/// a o b.
template <class A, class B>
typename A::PlainObject jordan_product(const Eigen::MatrixBase<A>& a,
                                       const Eigen::MatrixBase<B>& b) {
  typename A::PlainObject c = a(0) * b + b(0) * a;
  c(0) = 0.0;
  for (Eigen::Index k = 0; k < a.size(); ++k) c(0) += a(k) * b(k);
  return c;
}

/// a^-1 o b, that is c with a o c = b: c_0 = (a_0 b_0 - a_t.b_t) / det a, c_t = (b_t - c_0 a_t) /
/// a_0.
template <class A, class B>
typename A::PlainObject jordan_divide(const Eigen::MatrixBase<A>& a,
                                      const Eigen::MatrixBase<B>& b) {
  const double normal = lorentz_product(a, b) / lorentz_determinant(a);
  typename A::PlainObject c = (b - normal * a) / a(0);
  c(0) = normal;
  return c;
}

/// The longest step s <= `longest` with a + s d in L: the first s > 0 with
/// (a_0 + s d_0)^2 = |a_t + s d_t|^2, for a inside.
template <class A, class D>
double longest_step(const Eigen::MatrixBase<A>& a, const Eigen::MatrixBase<D>& d, double longest) {
  const double tangential = problems::tangential_norm(d);
  const double square = (d(0) - tangential) * (d(0) + tangential);
  const double along = lorentz_product(a, d);
  const double inside = lorentz_determinant(a);
  double step = longest;
  const double discriminant = along * along - square * inside;
  if (square < 0.0 || (along < 0.0 && discriminant >= 0.0)) {
    step = inside / (-along + std::sqrt(std::max(discriminant, 0.0)));
  }
  if (d(0) < 0.0) step = std::min(step, -a(0) / d(0));
  return std::clamp(step, 0.0, longest);
}

}  // namespace conebench::solvers
