#include "solvers/linear/sliding_system.h"

namespace conebench::solvers {

SlidingSystem::SlidingSystem(const problems::Problem& problem)
    : problem_(problem),
      rows_(problem),
      S_(problem),
      SC_(problem),
      mass_(rows_.mass(problem)),
      matrix_(mass_) {
  lu_.analyse(matrix_);
}

bool SlidingSystem::factorize(const BlockDiagonal& S, const BlockDiagonal& SC) {
  S_ = S;
  SC_ = SC;
  matrix_.coeffs() = mass_.coeffs();
  rows_.add_products(S, SC, false, matrix_);
  return lu_.factorize(matrix_);
}

Eigen::VectorXd SlidingSystem::solve(const Eigen::VectorXd& z) const {
  const Eigen::VectorXd x = lu_.solve(problem_.H().transpose() * S_.transpose_times(z));
  return z - SC_ * (problem_.H() * x);
}

}  // namespace conebench::solvers
