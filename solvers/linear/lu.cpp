#include "solvers/linear/lu.h"

#ifdef CONEBENCH_SUITESPARSE
#include <Eigen/UmfPackSupport>
#else
#include <Eigen/SparseLU>
#endif

namespace conebench::solvers {

#ifdef CONEBENCH_SUITESPARSE
struct Lu::Factor : Eigen::UmfPackLU<Matrix> {};
#else
struct Lu::Factor : Eigen::SparseLU<Matrix> {};
#endif

Lu::Lu() : factor_(std::make_unique<Factor>()) {}
Lu::~Lu() = default;
Lu::Lu(Lu&&) noexcept = default;

void Lu::analyse(const Matrix& matrix) { factor_->analyzePattern(matrix); }

bool Lu::factorize(const Matrix& matrix) {
  factor_->factorize(matrix);
  return factor_->info() == Eigen::Success;
}

Eigen::VectorXd Lu::solve(const Eigen::VectorXd& b) const { return factor_->solve(b); }

}  // namespace conebench::solvers
