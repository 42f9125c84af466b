#include "solvers/local/newton_fb.h"

#include "solvers/local/newton.h"

namespace conebench::solvers {
namespace {

constexpr double kSmallestEigenvalue = 1e-15;

// L_a: the matrix of b -> a o b = (a . b, a_0 b_t + b_0 a_t).
template <class Vector, class Matrix>
void arrow(const Vector& a, Matrix& L) {
  L.setIdentity();
  L *= a(0);
  L.row(0) = a.transpose();
  L.col(0) = a;
}

// z = (x o x + y o y)^{1/2} as its spectral form: eigenvalues low and high, axis e of the frame
// (1, -+e) / 2.
template <class Vector, class Tangent>
void root_of_squares(const Vector& x, const Vector& y, double& low, double& high, Tangent& e) {
  constexpr int T = Tangent::RowsAtCompileTime;
  const Eigen::Index tangents = x.size() - 1;
  e = x(0) * x.template segment<T>(1, tangents) + y(0) * y.template segment<T>(1, tangents);
  const double size = e.norm();
  if (size > 0.0) {
    e /= size;
  } else {
    e.setZero();
    e(0) = 1.0;
  }
  // x o x + y o y has the eigenvalues |x_t -+ x_0 e|^2 + |y_t -+ y_0 e|^2: sums of squares, where
  // |x|^2 + |y|^2 -+ 2 |x_0 x_t + y_0 y_t| would cancel.
  low = std::hypot((x.template segment<T>(1, tangents) - x(0) * e).norm(),
                   (y.template segment<T>(1, tangents) - y(0) * e).norm());
  high = std::hypot((x.template segment<T>(1, tangents) + x(0) * e).norm(),
                    (y.template segment<T>(1, tangents) + y(0) * e).norm());
}

}  // namespace

template <int D>
void NewtonFbLocal<D>::set(const Matrix& W, double lambda, double mu, double theta) {
  W_ = W;
  lambda_ = lambda;
  mu_ = mu;
  theta_ = theta;
}

template <int D>
template <class Point>
void NewtonFbLocal<D>::evaluate(const Vector& q, const Vector& r, Point& point) const {
  constexpr int T = D == Eigen::Dynamic ? D : D - 1;
  using Tangent = Eigen::Matrix<double, T, 1>;
  const Eigen::Index tangents = q.size() - 1;
  const double root = std::sqrt(lambda_);
  const double normal = std::max(mu_, 1.0), tangent = std::max(1.0 / mu_, 1.0);
  const Vector u = W_ * r + q;
  const double speed = u.template segment<T>(1, tangents).norm();

  Vector x = root * r, y = u / root;
  x(0) *= normal;
  x.template segment<T>(1, tangents) *= tangent;
  y(0) = (u(0) + theta_ * speed) / (normal * root);
  y.template segment<T>(1, tangents) /= tangent;
  Matrix dy = W_ / root;
  if (speed > 0.0) {
    dy.row(0) += (theta_ / (speed * root)) * (u.template segment<T>(1, tangents).transpose() *
                                              W_.template bottomRows<T>(tangents));
  }
  dy.row(0) /= normal;
  dy.template bottomRows<T>(tangents) /= tangent;

  double low = 0.0, high = 0.0;
  Tangent e(tangents);
  root_of_squares(x, y, low, high, e);
  point.scale = std::max(q.norm() / root, root * r.norm());
  point.F = x + y;
  point.F(0) -= 0.5 * (low + high);
  point.F.template segment<T>(1, tangents) -= 0.5 * (high - low) * e;

  // dx = root diag(normal, tangent, ..): columns.
  Vector dx = Vector::Constant(q.size(), root * tangent);
  dx(0) = root * normal;
  point.jacobian = dy;
  point.jacobian.diagonal() += dx;
  if (!(high > 0.0)) return;
  low = std::max(low, kSmallestEigenvalue * high);
  Matrix L(q.size(), q.size());
  arrow(x, L);
  Matrix squares = L * dx.asDiagonal();
  arrow(y, L);
  squares.noalias() += L * dy;
  // L_z^{-1} in the frame of z: 1/low and 1/high along (1, -+e), 2/(low + high) across.
  const Vector normal_part = squares.row(0).transpose();
  const Vector axial = squares.template bottomRows<T>(tangents).transpose() * e;
  const double across = 2.0 / (low + high);
  const Vector falling = (normal_part - axial) / low, rising = (normal_part + axial) / high;
  Matrix dz(q.size(), q.size());
  dz.template bottomRows<T>(tangents) =
      across * (squares.template bottomRows<T>(tangents) - e * axial.transpose());
  dz.template bottomRows<T>(tangents) += 0.5 * e * (rising - falling).transpose();
  dz.row(0) = 0.5 * (rising + falling).transpose();
  point.jacobian -= dz;
}

template <int D>
bool NewtonFbLocal<D>::solve(const Vector& q, Vector& r) const {
  auto equation = [&](const Vector& x, NewtonPoint<D>& point) { evaluate(q, x, point); };
  return solve_cone_by_newton<D>(equation, W_(0, 0), mu_, q, r);
}

template class NewtonFbLocal<2>;
template class NewtonFbLocal<3>;
template class NewtonFbLocal<6>;
template class NewtonFbLocal<Eigen::Dynamic>;

}  // namespace conebench::solvers
