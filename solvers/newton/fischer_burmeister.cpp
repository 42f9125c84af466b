#include "solvers/newton/fischer_burmeister.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace conebench::solvers {
namespace {

using problems::Cone;

// Below this ratio, sqrt(l1 / l2) is rounding.
constexpr double kKink = 1e-15;

// The arguments of the Jordan algebra, and the factors that made them.
struct Scaled {
  Scaled(const Cone& cone, const ConstPart& p, const ConstPart& u)
      : normal(std::max(cone.mu, 1.0)), tangent(std::max(1.0 / cone.mu, 1.0)), x(p), y(u) {
    const Eigen::Index tangents = p.size() - 1;
    x(0) *= normal;
    x.tail(tangents) *= tangent;
    y(0) = (u(0) + cone.theta * problems::tangential_norm(u)) / normal;
    y.tail(tangents) /= tangent;
  }
  double normal, tangent;
  Eigen::VectorXd x, y;
};

// (x^2 + y^2)^(1/2) in its eigenbasis.
struct Root {
  Root(const Eigen::VectorXd& x, const Eigen::VectorXd& y) {
    const Eigen::Index tangents = x.size() - 1;
    e = 2.0 * (x(0) * x.tail(tangents) + y(0) * y.tail(tangents));
    const double norm = e.norm();
    if (norm > 0.0) {
      e /= norm;
    } else {
      e = Eigen::VectorXd::Unit(tangents, 0);
    }
    high = std::sqrt(x.squaredNorm() + y.squaredNorm() + norm);
    low = std::hypot((x.tail(tangents) - x(0) * e).norm(), (y.tail(tangents) - y(0) * e).norm());
  }
  double middle() const { return 0.5 * (high + low); }

  double low, high;
  Eigen::VectorXd e;
};

Eigen::MatrixXd product(const Eigen::VectorXd& x) {
  Eigen::MatrixXd L = x(0) * Eigen::MatrixXd::Identity(x.size(), x.size());
  L.row(0) = x.transpose();
  L.col(0) = x;
  return L;
}

// I - L_c^-1 L_x.
Eigen::MatrixXd derivative(const Root& c, const Eigen::VectorXd& x) {
  const Eigen::Index dim = x.size();
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(dim, dim);
  if (!(c.high > 0.0)) return (1.0 - 0.5 * std::numbers::sqrt2) * identity;
  Eigen::VectorXd plus(dim), minus(dim);
  plus << 1.0, c.e;
  minus << 1.0, -c.e;
  const Eigen::MatrixXd along_plus = 0.5 * plus * plus.transpose();
  const Eigen::MatrixXd along_minus = 0.5 * minus * minus.transpose();
  Eigen::MatrixXd inverse =
      along_plus / c.high + (identity - along_plus - along_minus) / c.middle();
  if (c.low > kKink * c.high) inverse += along_minus / c.low;
  return identity - inverse * product(x);
}

void scalar_jacobian(double p, double u, PartMatrix dp, PartMatrix du) {
  const double norm = std::hypot(p, u);
  dp.setIdentity();
  du.setZero();
  dp(0, 0) -= norm > 0.0 ? p / norm : 0.5 * std::numbers::sqrt2;
  du(0, 0) = 1.0 - (norm > 0.0 ? u / norm : 0.5 * std::numbers::sqrt2);
}

bool is_scalar(const Cone& cone) { return cone.mu == 0.0 || cone.dim == 1; }

}  // namespace

void FischerBurmeister::value(const Cone& cone, const ConstPart& p, const ConstPart& u,
                              Part phi) const {
  const Eigen::Index tangents = p.size() - 1;
  if (is_scalar(cone)) {
    phi = p;
    phi(0) += u(0) - std::hypot(p(0), u(0));
    return;
  }
  const Scaled at(cone, p, u);
  const Root c(at.x, at.y);
  phi = at.x + at.y;
  phi(0) -= c.middle();
  phi.tail(tangents) -= 0.5 * (c.high - c.low) * c.e;
}

void FischerBurmeister::jacobian(const Cone& cone, const ConstPart& p, const ConstPart& u,
                                 PartMatrix dp, PartMatrix du) const {
  const Eigen::Index tangents = p.size() - 1;
  if (is_scalar(cone)) {
    scalar_jacobian(p(0), u(0), dp, du);
    return;
  }
  const Scaled at(cone, p, u);
  const Root c(at.x, at.y);
  dp = derivative(c, at.x);
  dp.col(0) *= at.normal;
  dp.rightCols(tangents) *= at.tangent;
  du = derivative(c, at.y);
  du.col(0) /= at.normal;
  du.rightCols(tangents) /= at.tangent;
  const double rate = problems::tangential_norm(u);
  if (rate > 0.0) {
    du.rightCols(tangents) += cone.theta / rate * du.col(0) * u.tail(tangents).transpose();
  }
}

}  // namespace conebench::solvers
