#include "solvers/linear/cholesky.h"

#ifdef CONEBENCH_SUITESPARSE
#include <Eigen/CholmodSupport>
#else
#include <Eigen/SparseCholesky>
#endif

namespace conebench::solvers {

constexpr double kSecondsPerFlop = 0.2e-9, kSecondsPerNonzero = 25e-9;

#ifdef CONEBENCH_SUITESPARSE
struct Cholesky::Factor : Eigen::CholmodDecomposition<Matrix, Eigen::Lower> {
  Factor() {
    cholmod().print = 0;     // a failed pivot is an answer, not a message
    cholmod().final_ll = 1;  // L L^T also where it is simplicial: an indefinite matrix fails
  }
  double flops() { return cholmod().fl; }
  double nonzeros() { return cholmod().lnz; }
};
#else
struct Cholesky::Factor : Eigen::SimplicialLLT<Matrix, Eigen::Lower> {
  double flops() const { return m_nonZerosPerCol.cast<double>().squaredNorm(); }
  double nonzeros() const { return m_nonZerosPerCol.cast<double>().sum(); }
};
#endif

Cholesky::Cholesky() : factor_(std::make_unique<Factor>()) {}
Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;

void Cholesky::analyse(const Matrix& matrix) { factor_->analyzePattern(matrix); }

bool Cholesky::factorize(const Matrix& matrix) {
  factor_->factorize(matrix);
  return factor_->info() == Eigen::Success;
}

double Cholesky::work_s() const {
  return kSecondsPerFlop * factor_->flops() + kSecondsPerNonzero * factor_->nonzeros();
}

Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& b) const { return factor_->solve(b); }

}  // namespace conebench::solvers
