#include "solvers/linear/cholesky.h"

#ifdef CONEBENCH_SUITESPARSE
#include <Eigen/CholmodSupport>
#else
#include <Eigen/SparseCholesky>
#endif

#include <algorithm>
#include <vector>

namespace conebench::solvers {

constexpr double kSecondsPerFlop = 0.04e-9, kSecondsPerNonzero = 3e-9;

#ifdef CONEBENCH_SUITESPARSE
// CHOLMOD, which would permute the matrix anew in every factorisation: its ordering is asked for
// once, and what it factorises from then on is in that order.
struct Cholesky::Factor : Eigen::CholmodDecomposition<Matrix, Eigen::Lower> {
  using Base = Eigen::CholmodDecomposition<Matrix, Eigen::Lower>;

  Factor() {
    cholmod().print = 0;     // a failed pivot is an answer, not a message
    cholmod().final_ll = 1;  // L L^T also where it is simplicial: an indefinite matrix fails
  }

  void analyse(const Matrix& matrix) {
    cholmod().nmethods = 0;  // its own choice
    cholmod().postorder = 1;
    analyzePattern(matrix);
    const int* order = static_cast<const int*>(m_cholmodFactor->Perm);
    order_.assign(order, order + matrix.cols());
    order_rows(matrix);
    cholmod().nmethods = 1;
    cholmod().method[0].ordering = CHOLMOD_NATURAL;
    cholmod().postorder = 0;
    analyzePattern(ordered_);
  }

  void factorize(const Matrix& matrix) {
    for (std::size_t k = 0; k < from_.size(); ++k) {
      ordered_.valuePtr()[k] = matrix.valuePtr()[from_[k]];
    }
    Base::factorize(ordered_);
  }

  Eigen::VectorXd solve(const Eigen::VectorXd& b) const {
    const Eigen::VectorXd y = Base::solve(b(order_));
    Eigen::VectorXd x(b.size());
    x(order_) = y;
    return x;
  }

  double flops() { return cholmod().fl; }
  double nonzeros() { return cholmod().lnz; }

 private:
  // ordered_ and from_ of the lower triangle of `matrix`.
  void order_rows(const Matrix& matrix) {
    std::vector<int> place(order_.size());
    for (std::size_t k = 0; k < order_.size(); ++k) {
      place[static_cast<std::size_t>(order_[k])] = static_cast<int>(k);
    }
    std::vector<Eigen::Triplet<double>> entries;
    for (int j = 0; j < matrix.outerSize(); ++j) {
      for (int k = matrix.outerIndexPtr()[j]; k < matrix.outerIndexPtr()[j + 1]; ++k) {
        if (matrix.innerIndexPtr()[k] < j) continue;
        const int row = place[static_cast<std::size_t>(matrix.innerIndexPtr()[k])];
        const int column = place[static_cast<std::size_t>(j)];
        entries.emplace_back(std::max(row, column), std::min(row, column), k);
      }
    }
    ordered_.resize(matrix.rows(), matrix.cols());
    ordered_.setFromTriplets(entries.begin(), entries.end());
    from_.assign(ordered_.valuePtr(), ordered_.valuePtr() + ordered_.nonZeros());
  }

  std::vector<int> order_;  // row k of the ordered matrix is row order_[k] of the given one
  std::vector<int> from_;   // stored value k of the ordered matrix is value from_[k] of the given
  Matrix ordered_;
};
#else
struct Cholesky::Factor : Eigen::SimplicialLLT<Matrix, Eigen::Lower> {
  void analyse(const Matrix& matrix) { analyzePattern(matrix); }
  double flops() const { return m_nonZerosPerCol.cast<double>().squaredNorm(); }
  double nonzeros() const { return m_nonZerosPerCol.cast<double>().sum(); }
};
#endif

Cholesky::Cholesky() : factor_(std::make_unique<Factor>()) {}
Cholesky::~Cholesky() = default;
Cholesky::Cholesky(Cholesky&&) noexcept = default;

// CHOLMOD has no factor of an empty matrix.
void Cholesky::analyse(const Matrix& matrix) {
  if (matrix.rows() > 0) factor_->analyse(matrix);
}

bool Cholesky::factorize(const Matrix& matrix) {
  if (matrix.rows() == 0) return true;
  factor_->factorize(matrix);
  return factor_->info() == Eigen::Success;
}

double Cholesky::work_s() const {
  return kSecondsPerFlop * factor_->flops() + kSecondsPerNonzero * factor_->nonzeros();
}

Eigen::VectorXd Cholesky::solve(const Eigen::VectorXd& b) const {
  return b.size() > 0 ? factor_->solve(b) : b;
}

}  // namespace conebench::solvers
