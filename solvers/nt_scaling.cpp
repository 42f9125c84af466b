#include "solvers/nt_scaling.h"

namespace conebench::solvers {

NtScalings::NtScalings(const problems::Problem& problem)
    : problem_(problem),
      eta_(static_cast<std::size_t>(problem.cone_count()), 1.0),
      v_(Eigen::VectorXd::Zero(problem.rows())),
      lambda_(v_) {
  for (const problems::Cone& cone : problem.cones()) {
    size_.push_back(cone.mu > 0.0 ? cone.dim : 1);
    root_mu_.push_back(cone.mu > 0.0 && cone.dim > 1 ? std::sqrt(cone.mu) : 1.0);
  }
}

void NtScalings::set(const Eigen::VectorXd& r, const Eigen::VectorXd& x) {
  for (int i = 0; i < problem_.cone_count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    with_dimension(size_[k], [&]<int D>() {
      using Vector = Eigen::Matrix<double, D, 1>;
      const Eigen::Index at = problem_.start(i), size = size_[k];
      Vector xi = root_mu_[k] * x.segment<D>(at, size);
      Vector rho = r.segment<D>(at, size) / root_mu_[k];
      xi(0) = x(at) / root_mu_[k];
      rho(0) = root_mu_[k] * r(at);
      const double xi_size = std::sqrt(lorentz_determinant(xi));
      const double rho_size = std::sqrt(lorentz_determinant(rho));
      eta_[k] = std::sqrt(xi_size / rho_size);
      const Vector a = xi / xi_size;
      Vector b = -rho / rho_size;
      b(0) = -b(0);  // J rho
      const double gamma = std::sqrt(0.5 * (1.0 + std::max(lorentz_product(a, b), 1.0)));
      Vector v = (a + b) / (2.0 * gamma);  // w
      const double scale = 1.0 / std::sqrt(2.0 * (v(0) + 1.0));
      v(0) += 1.0;
      v *= scale;
      double along = 0.0;
      for (Eigen::Index j = 0; j < size; ++j) along += 2.0 * v(j) * rho(j);
      Vector lambda = along * v + rho;
      lambda(0) -= 2.0 * rho(0);
      v_.segment<D>(at, size) = v;
      lambda_.segment<D>(at, size) = eta_[k] * lambda;
    });
  }
}

// N^-1 = (2 Jv (Jv)^T - J) / eta.
void NtScalings::write_R(BlockDiagonal& R) const {
  for (int i = 0; i < problem_.cone_count(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    const Eigen::Index at = problem_.start(i);
    auto block = R[i];
    block.setZero();
    for (int column = 0; column < size_[k]; ++column) {
      const double T = (column == 0 ? 1.0 / root_mu_[k] : root_mu_[k]) / eta_[k];
      for (int row = 0; row < size_[k]; ++row) {
        const double sign = (row == 0) == (column == 0) ? 1.0 : -1.0;
        const double J = row != column ? 0.0 : row == 0 ? 1.0 : -1.0;
        block(row, column) = T * (2.0 * sign * v_(at + row) * v_(at + column) - J);
      }
    }
  }
}

}  // namespace conebench::solvers
