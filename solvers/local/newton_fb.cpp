#include "solvers/local/newton_fb.h"

#include <algorithm>
#include <cmath>

#include "problems/cone.h"
#include "solvers/local/newton_solve.h"

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
void FischerBurmeisterCone<D>::set(const LocalProblem<D>& problem) {
  const Eigen::Index tangents = problem.W.rows() - 1;
  const double normal = problem.W(0, 0);
  const double tangential =
      problem.W.diagonal().tail(tangents).sum() / static_cast<double>(tangents);
  scale_ = std::pow((normal > 0.0 ? normal : problem.lambda) *
                        (tangential > 0.0 ? tangential : problem.lambda),
                    0.25) /
           std::sqrt(problem.mu);
}

template <int D>
void FischerBurmeisterCone<D>::evaluate(const LocalProblem<D>& problem, const Vector& u,
                                        const Vector& r, NewtonPoint<D>& point) const {
  using Matrix = Eigen::Matrix<double, D, D>;
  constexpr int T = D == Eigen::Dynamic ? D : D - 1;
  using Tangent = Eigen::Matrix<double, T, 1>;
  const Eigen::Index tangents = r.size() - 1;
  const double mu = problem.mu, theta = problem.theta;
  const Matrix& W = problem.W;
  const auto ut = u.template segment<T>(1, tangents);
  const double speed = ut.norm();

  // dx = diag(scaling).
  Vector scaling = Vector::Constant(r.size(), scale_);
  scaling(0) *= mu;
  const Vector x = scaling.cwiseProduct(r);
  Vector y = u.cwiseQuotient(scaling);
  y(0) += theta * speed / scaling(0);
  Matrix dy = scaling.cwiseInverse().asDiagonal() * W;
  if (speed > 0.0) {
    dy.row(0) +=
        (theta / (speed * scaling(0))) * (ut.transpose() * W.template bottomRows<T>(tangents));
  }

  double low = 0.0, high = 0.0;
  Tangent e(tangents);
  root_of_squares(x, y, low, high, e);
  point.F = x + y;
  point.F(0) -= 0.5 * (low + high);
  point.F.template segment<T>(1, tangents) -= 0.5 * (high - low) * e;

  point.jacobian = dy;
  point.jacobian.diagonal() += scaling;
  if (!(high > 0.0)) return;
  low = std::max(low, kSmallestEigenvalue * high);
  Matrix L(r.size(), r.size());
  arrow(x, L);
  Matrix squares = L * scaling.asDiagonal();
  arrow(y, L);
  squares.noalias() += L * dy;
  // L_z^{-1} in the frame of z: 1/low and 1/high along (1, -+e), 2/(low + high) across.
  const Vector normal_part = squares.row(0).transpose();
  const Vector axial = squares.template bottomRows<T>(tangents).transpose() * e;
  const double across = 2.0 / (low + high);
  const Vector falling = (normal_part - axial) / low, rising = (normal_part + axial) / high;
  Matrix dz(r.size(), r.size());
  dz.template bottomRows<T>(tangents) =
      across * (squares.template bottomRows<T>(tangents) - e * axial.transpose());
  dz.template bottomRows<T>(tangents) += 0.5 * e * (rising - falling).transpose();
  dz.row(0) = 0.5 * (rising + falling).transpose();
  point.jacobian -= dz;
}

template <int D>
double FischerBurmeisterCone<D>::squared_miss(const LocalProblem<D>& problem, const Vector& u,
                                              const Vector& r, const NewtonPoint<D>&) const {
  Vector u_hat = u;
  problems::add_de_saxce(problem.theta, u_hat);
  Vector projected = r - u_hat / problem.lambda;
  problems::project(problem.mu, projected);
  return (r - projected).squaredNorm();
}

template class NewtonLocal<2, FischerBurmeisterCone<2>>;
template class NewtonLocal<3, FischerBurmeisterCone<3>>;
template class NewtonLocal<6, FischerBurmeisterCone<6>>;
template class NewtonLocal<Eigen::Dynamic, FischerBurmeisterCone<Eigen::Dynamic>>;

}  // namespace conebench::solvers
