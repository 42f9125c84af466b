#pragma once

#include <optional>
#include <string>

#include "problems/problem.h"

namespace conebench::solvers {

/// Friction cones made of plane faces. With d_j = (cos(2 pi j / faces), sin(2 pi j / faces)),
///
///   K = { r : r_n >= 0, r_t in mu r_n P },   P = convex hull of the d_j,   inside the round cone,
///   |a|_P = max_j d_j.a,   u_hat = u + theta |-u_t|_P e_n,
///   K* contains u_hat,   orthogonal to   r in K,
///
/// is the round cone's law with P for the disk: theta = mu dissipates most among the reactions that
/// P allows and does not dilate, theta = 0 is convex. For d = 1 and 2, K is the round cone itself.
/// For d = 3 friction points along the d_j nearest to -u_t, up to pi / faces off, or, sliding
/// straight across a face, is a mean of two d_j, down to cos(pi / faces) of its size. By the
/// projection's non-expansiveness the eta of the round cone's law (theta = mu) at a solution is at
/// most max_i lambda_i mu_i r_in (pi / faces) / U: the model's gap falls as 1 / faces.
class PyramidLaw {
 public:
  /// `faces` even, >= 4: P = -P, of which only d = 3 takes notice.
  explicit PyramidLaw(int faces);

  /// Why a problem has no such law, or nothing: cones of d > 3 have more than a plane to slide in.
  static std::optional<std::string> refuses(const problems::Problem& problem);

  int faces() const { return faces_; }
  /// The directions d_j of a cone of this dimension, as columns: (d - 1) x {0, 2 or faces}.
  Eigen::MatrixXd directions(int dim) const;

  /// Euclidean projection on K, in place. d <= 3. Closed form.
  void project(double mu, Eigen::Ref<Eigen::VectorXd> r) const;
  /// u + theta |-u_t|_P e_n, in place. d <= 3.
  void shift_rate(double theta, Eigen::Ref<Eigen::VectorXd> u) const;

  /// eta with K and u_hat of this law: max_i lambda_i |r_i - P_K(r_i - u_hat_i / lambda_i)| / U.
  /// 0 if and only if r solves the model. One product with W. Precondition: !refuses(problem).
  double eta(const problems::Problem& problem, const Eigen::VectorXd& r) const;
  /// The same for u = W r + q.
  double eta(const problems::Problem& problem, const Eigen::VectorXd& r,
             const Eigen::VectorXd& u) const;

 private:
  int faces_;
  double cosine_, sine_;  // of pi / faces
};

}  // namespace conebench::solvers
