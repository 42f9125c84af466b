#include "solvers/local/newton_ac.h"

#include "solvers/local/newton_solve.h"

namespace conebench::solvers {

template <int D>
void AlartCurnierCone<D>::set(const LocalProblem<D>& problem) {
  const double normal = problem.W(0, 0);
  // The trace of W_tt is between |W_tt| and (d - 1)|W_tt|.
  const double tangential = problem.W.diagonal().tail(problem.W.rows() - 1).sum();
  rho_n_ = 1.0 / (normal > 0.0 ? normal : problem.lambda);
  rho_t_ = 1.0 / (tangential > 0.0 ? tangential : problem.lambda);
}

template <int D>
void AlartCurnierCone<D>::evaluate(const LocalProblem<D>& problem, const Vector& u, const Vector& r,
                                   NewtonPoint<D>& point) const {
  constexpr int T = D == Eigen::Dynamic ? D : D - 1;
  using Tangent = Eigen::Matrix<double, T, 1>;
  const Eigen::Index tangents = r.size() - 1;
  const auto ut = u.template segment<T>(1, tangents);
  const auto Wt = problem.W.template bottomRows<T>(tangents);
  const double speed = ut.norm(), dilation = problem.mu - problem.theta;

  const double z = r(0) - rho_n_ * (u(0) - dilation * speed);
  if (!(z > 0.0)) {
    point.F = r;
    point.jacobian.setIdentity();
    return;
  }
  Vector gap_slope = problem.W.row(0).transpose();
  if (dilation > 0.0 && speed > 0.0) gap_slope -= dilation / speed * (Wt.transpose() * ut);
  point.F(0) = r(0) - z;
  point.jacobian.row(0) = rho_n_ * gap_slope.transpose();

  const Tangent zt = r.template segment<T>(1, tangents) - rho_t_ * ut;
  const double radius = problem.mu * z, size = zt.norm();
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
  Jt.noalias() -= problem.mu * e * z_slope.transpose();
}

template <int D>
double AlartCurnierCone<D>::squared_miss(const LocalProblem<D>&, const Vector&, const Vector&,
                                         const NewtonPoint<D>& point) const {
  return point.F.squaredNorm();
}

template class NewtonLocal<2, AlartCurnierCone<2>>;
template class NewtonLocal<3, AlartCurnierCone<3>>;
template class NewtonLocal<6, AlartCurnierCone<6>>;
template class NewtonLocal<Eigen::Dynamic, AlartCurnierCone<Eigen::Dynamic>>;

}  // namespace conebench::solvers
