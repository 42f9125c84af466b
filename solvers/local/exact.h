#pragma once

#include <Eigen/Core>
#include <optional>

#include "solvers/local/isotropic.h"

namespace conebench::solvers {

/// How a one-cone problem was solved.
enum class LocalCase {
  kOpen,        ///< r = 0
  kStick,       ///< u = 0
  kSlide,       ///< r on the cone's surface, u_t against r_t
  kNoSolution,  ///< W is singular and no r satisfies the law; r is left as it was
};

/// One cone, exactly: given W (d x d, symmetric, PSD), mu and 0 <= theta <= mu, finds r with
///
///   u = W r + q,   K_mu* contains u + theta |u_t| e_n,  orthogonal to  r in K_mu.
///
/// Derivation. Open if q_n >= (mu - theta)|q_t|. Otherwise eliminate r_n through row n:
/// with w = W_tn / W_nn, S = W_tt - w w^T W_nn and b = q_t - w q_n, the tangential row reads
/// u_t = S r_t + b + w u_n. Stick (u = 0): r_t = -S^-1 b. Slide: u_t = -a r_t with a > 0 and
/// |r_t| = mu r_n, where u_n = (mu - theta)|u_t| = (mu - theta) a |r_t|. For theta = mu this
/// is u_n = 0, and
///
///   r_t(a) = -(S + a I)^-1 b,   r_n(a) = -q_n / W_nn - w . r_t(a),   |r_t(a)| = mu r_n(a),
///
/// one scalar equation, solved as psi(a) = mu r_n / |r_t| - 1 = 0, which is nearly linear in a
/// (exactly linear for d = 2), by bracketed Newton in the eigenbasis of S: O(d) an evaluation.
/// For theta < mu the same elimination is linear in rho = |r_t| for given a: see exact.cpp.
///
/// Singular W. Eigenvalues of S below 4e-15 |W| count as zero. null(W) is spanned by
/// (-w.y, y), S y = 0, so the best stick candidate has a closed form; for sliding, psi may start
/// positive, and its minimum over a decides whether there is a root.
///
/// set() costs one eigendecomposition of size d - 1 (closed form for d <= 3); solve() allocates
/// nothing for fixed D. D is the dimension, or Eigen::Dynamic. Instantiated for 1, 2, 3, 6 and
/// Eigen::Dynamic.
template <int D>
class ExactLocal {
 public:
  static constexpr int kTangents = D == Eigen::Dynamic ? Eigen::Dynamic : D - 1;
  using Vector = Eigen::Matrix<double, D, 1>;
  using Matrix = Eigen::Matrix<double, D, D>;
  using Tangent = Eigen::Matrix<double, kTangents, 1>;
  using TangentMatrix = Eigen::Matrix<double, kTangents, kTangents>;

  /// `W` symmetric with spectral norm `lambda`; both and the law stay fixed until the next call.
  void set(const Matrix& W, double lambda, double mu, double theta);

  /// A lower bound of the order of W's smallest eigenvalue; 0 where W counts as singular.
  double least_eigenvalue() const;

  /// The same problem where theta = mu and W = diag(W_nn, s I) to rounding, both positive.
  std::optional<IsotropicCone> isotropic() const;

  /// Whether q_n >= 0 alone says that r = 0.
  bool opens_by_normal() const { return theta_ == mu_; }

  /// Writes r. `slide_rate` is a: a guess on entry (<= 0: none), the answer of a slide on exit.
  LocalCase solve(const Vector& q, Vector& r, double& slide_rate) const;

 private:
  struct Reduced;  // the problem in the eigenbasis of S, for one q

  bool stick(const Reduced& p, Tangent& rt, double& rn) const;
  bool slide_coulomb(const Reduced& p, double& a, Tangent& rt, double& rn) const;
  bool slide_dilating(const Reduced& p, double& a, Tangent& rt, double& rn) const;

  double mu_ = 0.0, theta_ = 0.0;
  double Wnn_ = 0.0;
  Tangent w_;        // Q^T W_tn / W_nn, 0 if W_nn is
  Tangent s_;        // eigenvalues of S, increasing; those that count as zero are 0
  TangentMatrix Q_;  // eigenvectors of S, in columns
};

extern template class ExactLocal<1>;
extern template class ExactLocal<2>;
extern template class ExactLocal<3>;
extern template class ExactLocal<6>;
extern template class ExactLocal<Eigen::Dynamic>;

}  // namespace conebench::solvers
