#include "solvers/local/newton_ac.h"

#include "solvers/local/newton.h"

namespace conebench::solvers {

template <int D>
void NewtonAcLocal<D>::set(const Matrix& W, double lambda, double mu, double theta) {
  W_ = W;
  lambda_ = lambda;
  mu_ = mu;
  theta_ = theta;
  const Eigen::Index tangents = W.rows() - 1;
  // The trace of W_tt is between |W_tt| and (d - 1)|W_tt|.
  const double tangential = W.diagonal().tail(tangents).sum();
  rho_n_ = 1.0 / (W(0, 0) > 0.0 ? W(0, 0) : lambda);
  rho_t_ = 1.0 / (tangential > 0.0 ? tangential : lambda);
}

template <int D>
template <class Point>
void NewtonAcLocal<D>::evaluate(const Vector& q, const Vector& r, Point& point) const {
  constexpr int T = D == Eigen::Dynamic ? D : D - 1;
  using Tangent = Eigen::Matrix<double, T, 1>;
  const Eigen::Index tangents = q.size() - 1;
  const Vector u = W_ * r + q;
  const auto ut = u.template segment<T>(1, tangents);
  const auto Wt = W_.template bottomRows<T>(tangents);
  const double speed = ut.norm(), dilation = mu_ - theta_;
  point.scale = std::max(q.norm() / lambda_, r.norm());

  const double z = r(0) - rho_n_ * (u(0) - dilation * speed);
  if (!(z > 0.0)) {
    point.F = r;
    point.jacobian.setIdentity();
    return;
  }
  Vector gap_slope = W_.row(0).transpose();
  if (dilation > 0.0 && speed > 0.0) gap_slope -= dilation / speed * (Wt.transpose() * ut);
  point.F(0) = r(0) - z;
  point.jacobian.row(0) = rho_n_ * gap_slope.transpose();

  const Tangent zt = r.template segment<T>(1, tangents) - rho_t_ * ut;
  const double radius = mu_ * z, size = zt.norm();
  auto Ft = point.F.template segment<T>(1, tangents);
  auto Jt = point.jacobian.template bottomRows<T>(tangents);
  Jt = rho_t_ * Wt;
  if (size <= radius) {
    Ft = rho_t_ * ut;
    return;
  }
  // r_t - radius e, e = z_t / |z_t|, de = (I - e e^T) dz_t / |z_t|.
  const Tangent e = zt / size;
  Ft = r.template segment<T>(1, tangents) - radius * e;
  Jt.template rightCols<T>(tangents).diagonal().array() -= 1.0;  // -dz_t / dr
  const Eigen::Matrix<double, 1, D> along = e.transpose() * Jt;
  Jt = (radius / size) * (Jt - e * along).eval();
  Jt.template rightCols<T>(tangents).diagonal().array() += 1.0;
  Vector z_slope = -rho_n_ * gap_slope;
  z_slope(0) += 1.0;
  Jt.noalias() -= mu_ * e * z_slope.transpose();
}

template <int D>
bool NewtonAcLocal<D>::solve(const Vector& q, Vector& r) const {
  auto equation = [&](const Vector& x, NewtonPoint<D>& point) { evaluate(q, x, point); };
  return solve_cone_by_newton<D>(equation, W_(0, 0), mu_, q, r);
}

template class NewtonAcLocal<2>;
template class NewtonAcLocal<3>;
template class NewtonAcLocal<6>;
template class NewtonAcLocal<Eigen::Dynamic>;

}  // namespace conebench::solvers
