#include "solvers/projection_jacobian.h"

namespace conebench::solvers {

void project_with_jacobian(double mu, Eigen::Ref<Eigen::VectorXd> x, BlockDiagonal::Block J) {
  const Eigen::Index tangents = x.size() - 1;
  const double normal = x(0), tangential = x.tail(tangents).norm();
  if (tangential <= mu * normal && normal >= 0.0) {
    J.setIdentity();
    if (mu == 0.0) J.bottomRightCorner(tangents, tangents).setZero();
    return;
  }
  J.setZero();
  if (mu * tangential <= -normal) {
    x.setZero();
    return;
  }
  const double share = 1.0 / (1.0 + mu * mu);
  const double reach = (normal + mu * tangential) * share;
  J(0, 0) = share;
  if (mu > 0.0) {
    const Eigen::VectorXd e = x.tail(tangents) / tangential;
    const double turn = mu * reach / tangential;
    J.col(0).tail(tangents) = mu * share * e;
    J.row(0).tail(tangents) = J.col(0).tail(tangents).transpose();
    J.bottomRightCorner(tangents, tangents) = (mu * mu * share - turn) * e * e.transpose();
    J.bottomRightCorner(tangents, tangents).diagonal().array() += turn;
    x.tail(tangents) = mu * reach * e;
  } else {
    x.tail(tangents).setZero();
  }
  x(0) = reach;
}

}  // namespace conebench::solvers
