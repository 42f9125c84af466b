#pragma once

#include <Eigen/Core>

namespace conebench::solvers {

/// One Coulomb cone of d = 3 by enumeration: opening, sticking, then sliding as the real roots of a
/// quartic. The problem and the letters w, S, b are those of ExactLocal, with theta = mu.
///
/// Slide. r_t(a) = -(S + a I)^-1 b with S 2 x 2, t = tr S and D = det S, is -(adj(S) b + a b) /
/// (a^2 + t a + D). With push = -q_n / W_nn and both sides times the denominator,
///
///   N(a) = |adj(S) b + a b|^2,   P(a) = push (a^2 + t a + D) + w.adj(S) b + a w.b,
///   |r_t| = mu r_n   <=>   mu P(a) = sqrt(N(a)),   so   mu^2 P(a)^2 - N(a) = 0,
///
/// of degree 4 in a. Its roots are found in closed form, those with a > 0 and P > 0 polished by
/// Newton on mu P - sqrt(N), and the one of least mismatch taken.
///
/// Cost    one quartic a slide. Closed-form roots lose digits as W's condition grows, and a
///         singular W is beyond it: some slides of a condition of 1e8 or more go unfound.
/// Source  Bonnefon, Daviet, "Quartic formulation of Coulomb 3D frictional contact", INRIA RT-0400
///         (2011): the idea (not checked); the quartic above is our derivation.
class QuarticLocal {
 public:
  using Vector = Eigen::Vector3d;
  using Matrix = Eigen::Matrix3d;

  /// As ExactLocal::set, with theta = mu.
  void set(const Matrix& W, double lambda, double mu);
  const Matrix& W() const { return W_; }

  /// False if no case fits; r is left as it was.
  bool solve(const Vector& q, Vector& r) const;

 private:
  bool slide(double push, const Eigen::Vector2d& b, Eigen::Vector2d& rt) const;

  Matrix W_;
  double mu_ = 0.0;
  double lambda_ = 1.0;
  Eigen::Vector2d w_;         // W_tn / W_nn
  Eigen::Matrix2d adjugate_;  // of S
  double trace_ = 0.0, determinant_ = 0.0;
};

}  // namespace conebench::solvers
