#include "solvers/linear/cholesky.h"

#ifdef CONEBENCH_SUITESPARSE
#include <Eigen/CholmodSupport>
#else
#include <Eigen/SparseCholesky>
#endif

namespace conebench::solvers {

#ifdef CONEBENCH_SUITESPARSE
struct Cholesky::Factor : Eigen::CholmodDecomposition<Matrix, Eigen::Lower> {
  Factor() { cholmod().print = 0; }  // a failed pivot is an answer, not a message
};
#else
struct Cholesky::Factor : Eigen::SimplicialLLT<Matrix, Eigen::Lower> {};
#endif

Cholesky::Cholesky() : factor_(std::make_unique<Factor>()) {}
Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;

void Cholesky::analyse(const Matrix& matrix) { factor_->analyzePattern(matrix); }

bool Cholesky::factorize(const Matrix& matrix) {
  factor_->factorize(matrix);
  return factor_->info() == Eigen::Success;
}

Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& b) const { return factor_->solve(b); }

}  // namespace conebench::solvers
