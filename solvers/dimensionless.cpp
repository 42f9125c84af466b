#include "solvers/dimensionless.h"

#include <cmath>

namespace conebench::solvers {
namespace {

using problems::Problem;
using problems::SparseMatrix;

SparseMatrix scaled(const Eigen::VectorXd& left, const SparseMatrix& matrix,
                    const Eigen::VectorXd& right) {
  SparseMatrix result = left.asDiagonal() * matrix * right.asDiagonal();
  result.makeCompressed();
  return result;
}

}  // namespace

Dimensionless::Dimensionless(const Problem& problem) : force(problem.rows()), rate(problem.rows()) {
  const double largest = problem.cone_count() > 0 ? problem.mobility().maxCoeff() : 1.0;
  const double U = problem.rate_scale() > 0.0 ? problem.rate_scale() : 1.0;
  const double s = U / (kRateScale * std::sqrt(largest));
  energy = s * s;
  for (int i = 0; i < problem.cone_count(); ++i) {
    const int at = problem.start(i), dim = problem.start(i + 1) - at;
    const double root = std::sqrt(problem.mobility()(i));
    force.segment(at, dim).setConstant(s / root);
    rate.segment(at, dim).setConstant(s * root);
  }
  const Eigen::VectorXd from_rate = rate.cwiseInverse();
  if (!problem.is_primal()) {
    W = scaled(from_rate, problem.W(), force);
    q = from_rate.cwiseProduct(problem.q());
    return;
  }
  velocity = s * problem.M().diagonal().cwiseSqrt().cwiseInverse();
  M = scaled(velocity / s, problem.M(), velocity / s);
  H = scaled(from_rate, problem.H(), velocity);
  f = velocity.cwiseProduct(problem.f()) / energy;
  w = from_rate.cwiseProduct(problem.w());
}

}  // namespace conebench::solvers
