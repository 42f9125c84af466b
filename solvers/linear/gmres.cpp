#include "solvers/linear/gmres.h"

#include <Eigen/QR>
#include <cmath>

namespace conebench::solvers {

KrylovAnswer gmres(const std::function<Eigen::VectorXd(const Eigen::VectorXd&)>& apply,
                   const Eigen::VectorXd& b, double share, int most) {
  const double size = b.norm();
  if (!(size > 0.0) || !std::isfinite(size)) return {Eigen::VectorXd::Zero(b.size()), 0};
  Eigen::MatrixXd basis(b.size(), most + 1);
  Eigen::MatrixXd image = Eigen::MatrixXd::Zero(most + 1, most);
  Eigen::VectorXd target = Eigen::VectorXd::Zero(most + 1), weights;
  target(0) = size;
  basis.col(0) = b / size;
  int iterations = 0;
  while (iterations < most) {
    const int k = iterations++;
    Eigen::VectorXd next = apply(basis.col(k));
    for (int j = 0; j <= k; ++j) {
      image(j, k) = basis.col(j).dot(next);
      next -= image(j, k) * basis.col(j);
    }
    image(k + 1, k) = next.norm();
    const auto small = image.topLeftCorner(k + 2, k + 1);
    weights = small.householderQr().solve(target.head(k + 2));
    const double left = (target.head(k + 2) - small * weights).norm();
    if (left <= share * size || !(image(k + 1, k) > 0.0)) break;
    basis.col(k + 1) = next / image(k + 1, k);
  }
  return {basis.leftCols(weights.size()) * weights, iterations};
}

}  // namespace conebench::solvers
