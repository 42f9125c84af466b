#include "solvers/local/exact.h"

#include <Eigen/Eigenvalues>

#include "solvers/local/bracket.h"

namespace conebench::solvers {
namespace {

// Eigenvalues of S below this share of |W|_2 count as zero: above the rounding of S (a few eps),
// and below the smallest eigenvalue of a W of condition 1e14, since that of S is no smaller.
constexpr double kZeroEigenvalue = 4e-15;
constexpr double kZeroDiagonal = 1e-16;
// q counts as in range(W) when its part in null(W) is below this share of it.
constexpr double kInRange = 1e-13;
// With theta < mu, a cone this close to opening, as a share of |q|, is open: the slide's equation
// would be made of rounding, while r = 0 is wrong by no more than the gap.
constexpr double kOpenGap = 1e-13;
// Beyond this multiple of the eigenvalues, a slide is an opening.
constexpr double kOpenWithinRounding = 1e17;
// psi varies on the scale of a itself, so Newton's error after a step of this relative size is
// about its square: rounding.
constexpr double kQuadratic = 1e-8;
// Points of the scan for the valley of psi when S is singular.
constexpr int kScanPoints = 400;

// S = Q diag(s) Q^T, s increasing. Dimensions without a closed form share one instantiation.
template <class Matrix, class Vector>
void diagonalise(const Matrix& S, Vector& s, Matrix& Q) {
  if constexpr (Matrix::RowsAtCompileTime == 0) {
    return;
  } else if constexpr (Matrix::RowsAtCompileTime == 1) {
    s(0) = S(0, 0);
    Q(0, 0) = 1.0;
  } else if constexpr (Matrix::RowsAtCompileTime == 2) {
    Eigen::SelfAdjointEigenSolver<Matrix> eigen;
    eigen.computeDirect(S);
    s = eigen.eigenvalues();
    Q = eigen.eigenvectors();
  } else {
    if (S.rows() == 0) {
      s.resize(0);
      Q.resize(0, 0);
      return;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(S);
    s = eigen.eigenvalues();
    Q = eigen.eigenvectors();
  }
}

}  // namespace

template <int D>
struct ExactLocal<D>::Reduced {
  double qn;      // q_n
  double push;    // -q_n / W_nn
  Tangent b;      // Q^T b; 0 exactly where S is singular and q is in range(W)
  bool in_range;  // no nonzero b where S is singular
};

template <int D>
void ExactLocal<D>::set(const Matrix& W, double lambda, double mu, double theta) {
  mu_ = mu;
  theta_ = theta;
  const Eigen::Index tangents = W.rows() - 1;
  Wnn_ = W(0, 0) > kZeroDiagonal * lambda ? W(0, 0) : 0.0;
  TangentMatrix S = W.bottomRightCorner(tangents, tangents);
  w_ = Tangent::Zero(tangents);
  if (Wnn_ > 0.0) {
    w_ = W.col(0).tail(tangents) / Wnn_;
    S -= w_ * W.col(0).tail(tangents).transpose();
  }
  diagonalise(S, s_, Q_);
  for (double& value : s_) value = value > kZeroEigenvalue * lambda ? value : 0.0;
  w_ = (Q_.transpose() * w_).eval();
}

template <int D>
std::optional<IsotropicCone> ExactLocal<D>::isotropic() const {
  if (s_.size() == 0 || theta_ != mu_ || Wnn_ == 0.0) return std::nullopt;
  const double least = s_.minCoeff(), largest = s_.maxCoeff();
  const double rounding = kZeroEigenvalue * std::max(Wnn_, largest);
  if (least == 0.0 || largest - least > rounding || Wnn_ * w_.norm() > rounding) {
    return std::nullopt;
  }
  return IsotropicCone(Wnn_, s_.mean(), mu_);
}

// W = L diag(W_nn, S) L^T with |L^-1|^2 <= 2 (1 + |w|^2).
template <int D>
double ExactLocal<D>::least_eigenvalue() const {
  if (s_.size() == 0) return Wnn_;
  return std::min(Wnn_, s_.minCoeff()) / (2.0 * (1.0 + w_.squaredNorm()));
}

// min over y of |r_t| - mu r_n, where the components y of r_t in null(S) are free and move r_n by
// -w.y. With p the fixed part of r_t and x the r_n at y = 0:  sqrt(p^2 + y^2) - mu (x - w.y).
template <int D>
bool ExactLocal<D>::stick(const Reduced& p, Tangent& rt, double& rn) const {
  if (!p.in_range || Wnn_ == 0.0) return false;
  double free_square = 0.0, normal = p.push;
  for (Eigen::Index k = 0; k < s_.size(); ++k) {
    const double component = s_(k) > 0.0 ? -p.b(k) / s_(k) : 0.0;
    rt(k) = component;
    normal -= w_(k) * component;
    if (s_(k) == 0.0) free_square += w_(k) * w_(k);
  }
  rn = normal;
  if (rn >= 0.0 && rt.squaredNorm() <= mu_ * mu_ * rn * rn) return true;
  if (free_square == 0.0) return false;
  const double fixed = rt.norm();

  const double slope = mu_ * std::sqrt(free_square);  // gain in mu r_n per unit of y
  const double start = mu_ * rn;
  double y;
  if (slope < 1.0) {
    const double root = std::sqrt((1.0 - slope) * (1.0 + slope));
    if (fixed * root > start) return false;
    y = slope * fixed / root;
  } else if (slope > 1.0) {
    const double excess = (slope - 1.0) * (slope + 1.0);
    y = (-slope * start + std::sqrt(start * start + excess * fixed * fixed)) / excess;
  } else {
    if (!(start > 0.0)) return false;
    y = (fixed - start) * (fixed + start) / (2.0 * start);
  }
  for (Eigen::Index k = 0; k < s_.size(); ++k) {
    if (s_(k) == 0.0) rt(k) = -y * w_(k) / std::sqrt(free_square);
  }
  rn += y * std::sqrt(free_square);
  return true;
}

template <int D>
bool ExactLocal<D>::slide_coulomb(const Reduced& p, double& a, Tangent& rt, double& rn) const {
  if (Wnn_ == 0.0) return false;
  const double b_size = p.b.norm();
  if (!(b_size > 0.0)) return false;
  // psi and its derivative; leaves r_t(a) and its derivative behind.
  Tangent rt_slope = p.b;
  auto psi = [&](double x, double* slope) {
    double square = 0.0, square_slope = 0.0, normal = p.push, normal_slope = 0.0;
    for (Eigen::Index k = 0; k < s_.size(); ++k) {
      const double inverse = p.b(k) == 0.0 ? 0.0 : 1.0 / (s_(k) + x);
      rt(k) = -p.b(k) * inverse;
      rt_slope(k) = -rt(k) * inverse;
      normal -= w_(k) * rt(k);
      normal_slope -= w_(k) * rt_slope(k);
      square += rt(k) * rt(k);
      square_slope += rt(k) * rt_slope(k);
    }
    const double inverse_size = 1.0 / std::sqrt(square);
    const double scale = mu_ * inverse_size;
    if (slope) {
      *slope = scale * (normal_slope - normal * square_slope * inverse_size * inverse_size);
    }
    return scale * normal - 1.0;
  };

  // |r_t| = mu r_n >= mu (push - |w||r_t|) bounds |r_t| from below and so a from above.
  const double least = mu_ * p.push / (1.0 + mu_ * w_.norm());
  double low = 0.0, high = 2.0 * b_size / least;
  if (!p.in_range) {
    // r_t blows up as a -> 0: psi(0+) = mu w.b0/|b0| - 1, b0 the part of b in null(S).
    double along = 0.0, square = 0.0;
    for (Eigen::Index k = 0; k < s_.size(); ++k) {
      if (s_(k) > 0.0) continue;
      along += w_(k) * p.b(k);
      square += p.b(k) * p.b(k);
    }
    if (mu_ * along >= std::sqrt(square)) {
      auto value = [&](double x) { return psi(x, nullptr); };
      low = log_minimum(value, 1e-18 * high, high, kScanPoints);
      if (value(low) > 0.0) return false;
    }
  }

  double x = a > low && a < high ? a : 0.5 * (low + high);
  for (int evaluation = 0; evaluation < 100; ++evaluation) {
    double slope = 0.0;
    const double value = psi(x, &slope);
    (value < 0.0 ? low : high) = x;
    const double step = -value / slope;
    if (std::abs(step) <= kQuadratic * x) {  // r_t likewise to first order
      a = x + step;
      rt += step * rt_slope;
      rn = rt.norm() / mu_;
      return true;
    }
    x = x + step > low && x + step < high ? x + step : 0.5 * (low + high);
    if (high - low <= 1e-15 * high) break;
  }
  a = x;
  psi(x, nullptr);
  rn = rt.norm() / mu_;
  return true;
}

// For theta < mu, with c = mu - theta and rho = |r_t|: r_t = -(alpha + rho beta), where
// alpha = (S + a I)^-1 b and beta = c a (S + a I)^-1 w, and row n gives rho N = ... explicitly:
//   rho = N / D,   N = mu (W_nt alpha - q_n),   D = W_nn - mu c a - mu W_nt beta.
// The slide is |D alpha + N beta| = |N| with N D > 0. D falls from W_nn to -inf, through 0 at a*.
// There |beta| < 1 (from y^T W y > 0 for the null vector y of W + a diag(-mu c, I)), so for W > 0 a
// root lies left of a* when N(a*) > 0 and right of it when N(a*) < 0.
template <int D>
bool ExactLocal<D>::slide_dilating(const Reduced& p, double& a, Tangent& rt, double& rn) const {
  const double dilation = mu_ - theta_;
  Tangent beta = w_;
  double N = 0.0, Dn = 0.0;
  auto evaluate = [&](double x) {
    double coupling = 0.0;
    N = -p.qn;
    for (Eigen::Index k = 0; k < s_.size(); ++k) {
      const double inverse = 1.0 / (s_(k) + x);
      rt(k) = p.b(k) == 0.0 ? 0.0 : p.b(k) * inverse;
      beta(k) = dilation * x * inverse * w_(k);
      N += Wnn_ * w_(k) * rt(k);
      coupling += Wnn_ * w_(k) * beta(k);
    }
    N *= mu_;
    Dn = Wnn_ - mu_ * dilation * x - mu_ * coupling;
  };
  auto denominator = [&](double x) {
    evaluate(x);
    return Dn;
  };
  const double pole =
      Wnn_ > 0.0 ? bracketed_root(denominator, 1e-300, Wnn_ / (mu_ * dilation) * (1.0 + 1e-12))
                 : 0.0;
  // Left of the pole D > 0 and N must be > 0; right of it both must be negative.
  evaluate(std::max(pole, 1e-300));
  const double sign = N > 0.0 && pole > 0.0 ? 1.0 : -1.0;
  auto mismatch = [&](double x) {
    evaluate(x);
    return (Dn * rt + N * beta).norm() - sign * N;
  };
  double low = sign > 0.0 ? 1e-300 : std::max(pole, 1e-300), high = pole;
  if (sign < 0.0) {
    high = std::max({2.0 * pole, s_.size() > 0 ? s_.maxCoeff() : 0.0, 1e-30});
    const double largest = kOpenWithinRounding * high;
    while (high < largest && mismatch(high) <= 0.0) high *= 2.0;
    if (mismatch(high) <= 0.0) {  // a -> inf is r -> 0: open, up to rounding
      rt.setZero();
      rn = 0.0;
      return true;
    }
  }
  if (sign > 0.0 && mismatch(low) <= 0.0) return false;
  if (sign > 0.0 ? mismatch(high) > 0.0 : mismatch(low) > 0.0) return false;
  a = bracketed_root(mismatch, low, high);
  evaluate(a);
  const double rho = N / Dn;
  if (!(rho > 0.0) || !std::isfinite(rho)) return false;
  rt = -(rt + rho * beta);
  rn = rt.norm() / mu_;
  return true;
}

template <int D>
LocalCase ExactLocal<D>::solve(const Vector& q, Vector& r, double& slide_rate) const {
  const Eigen::Index tangents = q.size() - 1;
  const double qn = q(0);
  // No square root where theta = mu needs none: all that follows waits for this branch.
  if (theta_ == mu_ ? qn >= 0.0
                    : qn >= (mu_ - theta_) * q.template segment<kTangents>(1, tangents).norm() -
                                kOpenGap * q.norm()) {
    r.setZero();
    return LocalCase::kOpen;
  }
  if (mu_ == 0.0 || tangents == 0) {
    if (Wnn_ == 0.0) return LocalCase::kNoSolution;
    r.setZero();
    r(0) = -qn / Wnn_;
    return LocalCase::kStick;
  }
  if (Wnn_ == 0.0 && theta_ == mu_) return LocalCase::kNoSolution;

  Reduced p;
  p.qn = qn;
  p.push = Wnn_ > 0.0 ? -qn / Wnn_ : 0.0;
  p.b = Q_.transpose().lazyProduct(q.template segment<kTangents>(1, tangents)) - w_ * qn;
  p.in_range = true;
  for (Eigen::Index k = 0; k < tangents; ++k) {
    if (s_(k) > 0.0) continue;
    // b_k is q along the null vector (-w_k, e_k).
    if (std::abs(p.b(k)) <= kInRange * q.norm() * std::sqrt(1.0 + w_(k) * w_(k))) p.b(k) = 0.0;
    p.in_range = p.in_range && p.b(k) == 0.0;
  }

  Tangent rt = p.b;
  double rn = 0.0;
  LocalCase found = LocalCase::kStick;
  if (!stick(p, rt, rn)) {
    found = LocalCase::kSlide;
    const bool solved = theta_ == mu_ ? slide_coulomb(p, slide_rate, rt, rn)
                                      : slide_dilating(p, slide_rate, rt, rn);
    if (!solved) return LocalCase::kNoSolution;
  }
  Vector answer(tangents + 1);
  answer(0) = rn;
  for (Eigen::Index i = 0; i < tangents; ++i) {
    answer(i + 1) = Q_.row(i).transpose().cwiseProduct(rt).sum();
  }
  r = answer;
  return found;
}

template class ExactLocal<1>;
template class ExactLocal<2>;
template class ExactLocal<3>;
template class ExactLocal<6>;
template class ExactLocal<Eigen::Dynamic>;

}  // namespace conebench::solvers
