#include "solvers/local/quartic.h"

#include <Eigen/LU>

#include <cmath>
#include <limits>

#include "solvers/local/quartic_roots.h"

namespace conebench::solvers {
namespace {

// As in exact.cpp: what counts as zero beside |W|.
constexpr double kZeroEigenvalue = 4e-15;
constexpr double kZeroDiagonal = 1e-16;
constexpr int kPolishingSteps = 20;
constexpr double kLargestMismatch = 1e-6;  // of mu P and sqrt(N) at an accepted root

// c0 + c1 a + c2 a^2.
struct Quadratic {
  double c0, c1, c2;
  double operator()(double a) const { return (c2 * a + c1) * a + c0; }
  double slope(double a) const { return 2.0 * c2 * a + c1; }
};

// Newton on f = mu P - sqrt(N) from a > 0; the mismatch |f| / sqrt(N) left, infinite for a root
// that is no slide.
double polish(const Quadratic& P, const Quadratic& N, double mu, double& a) {
  auto mismatch = [&](double x) { return std::abs(mu * P(x) - std::sqrt(N(x))) / std::sqrt(N(x)); };
  double left = mismatch(a);
  for (int step = 0; step < kPolishingSteps; ++step) {
    const double root = std::sqrt(N(a));
    const double next = a - (mu * P(a) - root) / (mu * P.slope(a) - 0.5 * N.slope(a) / root);
    if (!(next > 0.0) || !(mismatch(next) < left)) break;
    a = next;
    left = mismatch(a);
  }
  return P(a) > 0.0 && N(a) > 0.0 ? left : std::numeric_limits<double>::infinity();
}

}  // namespace

void QuarticLocal::set(const Matrix& W, double lambda, double mu) {
  W_ = W;
  mu_ = mu;
  lambda_ = lambda;
  if (W(0, 0) <= kZeroDiagonal * lambda) {
    W_(0, 0) = 0.0;
    return;
  }
  w_ = W.col(0).tail<2>() / W(0, 0);
  const Eigen::Matrix2d S = W.bottomRightCorner<2, 2>() - w_ * W.col(0).tail<2>().transpose();
  adjugate_ << S(1, 1), -S(0, 1), -S(1, 0), S(0, 0);
  trace_ = S.trace();
  determinant_ = S.determinant();
  if (determinant_ <= kZeroEigenvalue * lambda * trace_) determinant_ = 0.0;
}

// With a = trace x, so that the quartic's coefficients are of the size of push and b.
bool QuarticLocal::slide(double push, const Eigen::Vector2d& b, Eigen::Vector2d& rt) const {
  const double unit = trace_ > 0.0 ? trace_ : lambda_;
  const Eigen::Vector2d c = adjugate_ * b / (unit * unit), e = b / unit;
  const double t = trace_ / unit, det = determinant_ / (unit * unit);
  const Quadratic N{c.squaredNorm(), 2.0 * c.dot(e), e.squaredNorm()};
  const Quadratic P{push * det + w_.dot(c), push * t + w_.dot(e), push};
  const double top = mu_ * mu_ * P.c2 * P.c2, square = mu_ * mu_ / top;
  double roots[4];
  const int count = nearly_real_quartic_roots(
      2.0 * square * P.c2 * P.c1, square * (P.c1 * P.c1 + 2.0 * P.c2 * P.c0) - N.c2 / top,
      2.0 * square * P.c1 * P.c0 - N.c1 / top, square * P.c0 * P.c0 - N.c0 / top, roots);
  double best = kLargestMismatch;
  bool found = false;
  for (int k = 0; k < count; ++k) {
    double x = roots[k];
    if (!(x > 0.0)) continue;
    const double left = polish(P, N, mu_, x);
    if (!(left < best)) continue;
    best = left;
    found = true;
    rt = -(c + x * e) / ((x + t) * x + det);
  }
  return found;
}

bool QuarticLocal::solve(const Vector& q, Vector& r) const {
  if (q(0) >= 0.0) {
    r.setZero();
    return true;
  }
  if (W_(0, 0) == 0.0) return false;
  const double push = -q(0) / W_(0, 0);
  if (mu_ == 0.0) {
    r = {push, 0.0, 0.0};
    return true;
  }
  const Eigen::Vector2d b = q.tail<2>() - w_ * q(0);
  if (determinant_ > 0.0) {
    const Eigen::Vector2d rt = -(adjugate_ * b) / determinant_;
    const double rn = push - w_.dot(rt);
    if (rt.norm() <= mu_ * rn) {
      r << rn, rt;
      return true;
    }
  }
  Eigen::Vector2d rt;
  if (!slide(push, b, rt)) return false;
  r << rt.norm() / mu_, rt;
  return true;
}

}  // namespace conebench::solvers
