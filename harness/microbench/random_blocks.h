#pragma once

#include <Eigen/Dense>
#include <random>

namespace conebench::solvers {

/// How well conditioned a random one-cone problem is.
enum class Conditioning { kGood, kHard, kExtreme, kSingular };  // 10, 1e8, 1e14, rank < d

/// A random symmetric PSD d x d matrix with largest eigenvalue in [1e-3, 1e3], log-uniform spectrum
/// down to its condition number; a kSingular one has 1 to d - 1 exact zeros before rotation.
inline Eigen::MatrixXd random_block(std::mt19937_64& random, int d, Conditioning kind) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform;
  Eigen::MatrixXd gaussian(d, d);
  for (double& x : gaussian.reshaped()) x = normal(random);
  const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(gaussian).householderQ();
  const double decades = kind == Conditioning::kHard      ? 8.0
                         : kind == Conditioning::kExtreme ? 14.0
                                                          : 1.0;
  Eigen::VectorXd spectrum(d);
  for (int k = 0; k < d; ++k) spectrum(k) = std::pow(10.0, -decades * uniform(random));
  spectrum(0) = 1.0;
  spectrum(d - 1) = std::pow(10.0, -decades);
  if (kind == Conditioning::kSingular) {
    const int zeros = 1 + static_cast<int>(uniform(random) * (d - 1));
    spectrum.tail(std::min(zeros, d - 1)).setZero();
  }
  spectrum *= std::pow(10.0, 6.0 * uniform(random) - 3.0);
  const Eigen::MatrixXd W = Q * spectrum.asDiagonal() * Q.transpose();
  return 0.5 * (W + W.transpose());
}

/// A random q; for a singular W half of them lie in range(W).
inline Eigen::VectorXd random_rate(std::mt19937_64& random, const Eigen::MatrixXd& W,
                                   Conditioning kind) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd q(W.rows());
  for (double& x : q) x = normal(random);
  if (kind == Conditioning::kSingular && normal(random) > 0.0) return W * q;
  return q * std::exp(normal(random));
}

}  // namespace conebench::solvers
