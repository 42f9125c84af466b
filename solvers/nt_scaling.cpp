#include "solvers/nt_scaling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace conebench::solvers {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// a_0^2 - |a_t|^2 without cancellation between squares; >= a tiny positive number.
double determinant(const VectorXd& a) {
  const double tangential = a.tail(a.size() - 1).norm();
  return std::max((a(0) - tangential) * (a(0) + tangential), std::numeric_limits<double>::min());
}

}  // namespace

void NtScaling::set(double mu, const VectorXd& r, const VectorXd& x) {
  dim_ = r.size();
  const Index size = mu > 0.0 ? dim_ : 1;
  diagonal_ = VectorXd::Constant(size, mu > 0.0 && dim_ > 1 ? std::sqrt(mu) : 1.0);
  diagonal_(0) = 1.0 / diagonal_(0);
  const VectorXd xi = diagonal_.cwiseProduct(x.head(size));
  const VectorXd rho = r.head(size).cwiseQuotient(diagonal_);
  const double xi_size = std::sqrt(determinant(xi)), rho_size = std::sqrt(determinant(rho));
  eta_ = std::sqrt(xi_size / rho_size);
  const VectorXd a = xi / xi_size;
  VectorXd b = -rho / rho_size;
  b(0) = -b(0);  // J rho
  const double dot = a(0) * b(0) - a.tail(size - 1).dot(b.tail(size - 1));
  const double gamma = std::sqrt(0.5 * (1.0 + std::max(dot, 1.0)));
  v_ = (a + b) / (2.0 * gamma);  // w
  const double scale = 1.0 / std::sqrt(2.0 * (v_(0) + 1.0));
  v_(0) += 1.0;
  v_ *= scale;
  lambda_ = apply(rho, false);
}

VectorXd NtScaling::apply(const VectorXd& a, bool inverse) const {
  const Index tangents = a.size() - 1;
  const double sign = inverse ? -1.0 : 1.0;
  // N = eta (2 v v^T - J);  N^-1 = (2 Jv (Jv)^T - J) / eta.
  const double along = 2.0 * (v_(0) * a(0) + sign * v_.tail(tangents).dot(a.tail(tangents)));
  VectorXd result(a.size());
  result(0) = along * v_(0) - a(0);
  result.tail(tangents) = sign * along * v_.tail(tangents) + a.tail(tangents);
  return (inverse ? 1.0 / eta_ : eta_) * result;
}

void NtScaling::write_R(Eigen::Ref<Eigen::MatrixXd> R) const {
  R.setZero();
  for (Index k = 0; k < size(); ++k) {
    VectorXd unit = VectorXd::Zero(size());
    unit(k) = diagonal_(k);
    R.col(k).head(size()) = apply(unit, true);
  }
}

VectorXd jordan_product(const VectorXd& a, const VectorXd& b) {
  VectorXd c = a(0) * b + b(0) * a;
  c(0) = a.dot(b);
  return c;
}

// a o c = b: c_0 = (a_0 b_0 - a_t.b_t) / det a, c_t = (b_t - c_0 a_t) / a_0.
VectorXd jordan_divide(const VectorXd& a, const VectorXd& b) {
  const Index tangents = a.size() - 1;
  VectorXd c(a.size());
  c(0) = (a(0) * b(0) - a.tail(tangents).dot(b.tail(tangents))) / determinant(a);
  c.tail(tangents) = (b.tail(tangents) - c(0) * a.tail(tangents)) / a(0);
  return c;
}

// The first s > 0 with (a_0 + s d_0)^2 = |a_t + s d_t|^2, a inside.
double longest_step(const VectorXd& a, const VectorXd& d, double longest) {
  const Index tangents = a.size() - 1;
  const double tangential = d.tail(tangents).norm();
  const double A = (d(0) - tangential) * (d(0) + tangential);
  const double B = a(0) * d(0) - a.tail(tangents).dot(d.tail(tangents));
  const double C = determinant(a);
  double step = longest;
  const double discriminant = B * B - A * C;
  if (A < 0.0 || (B < 0.0 && discriminant >= 0.0)) {
    step = C / (-B + std::sqrt(std::max(discriminant, 0.0)));
  }
  if (d(0) < 0.0) step = std::min(step, -a(0) / d(0));
  return std::clamp(step, 0.0, longest);
}

}  // namespace conebench::solvers
