#pragma once

#include <Eigen/SparseCore>
#include <span>
#include <vector>

#include "solvers/block_diagonal.h"

namespace conebench::solvers {

/// The rows of H cone by cone: which dofs a cone touches, and its dense block H_i on them, from
/// which matrices of size dofs, M + sum_i (A_i H_i)^T B_i H_i, are assembled into one pattern.
class ConeRows {
 public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

  explicit ConeRows(const problems::Problem& problem);

  /// M in the pattern of all such matrices, zeros stored: its lower triangle, or all of it.
  Matrix lower_mass(const problems::Problem& problem) const;
  Matrix mass(const problems::Problem& problem) const;

  /// Adds (A_i H_i)^T B_i H_i of every cone whose B_i is not 0 to a matrix of that pattern; to a
  /// `lower` triangle, what belongs there.
  void add_products(const BlockDiagonal& A, const BlockDiagonal& B, bool lower, Matrix& matrix);

 private:
  std::span<const int> dofs(int i) const {
    const auto k = static_cast<std::size_t>(i);
    return {dofs_.data() + begin_[k], begin_[k + 1] - begin_[k]};
  }
  template <int D>
  void add_product(int i, const double* a, const double* b, bool lower, Matrix& matrix);

  std::vector<std::size_t> begin_, value_begin_;
  std::vector<int> dims_, dofs_;
  std::vector<double> values_;        // H_i, column-major
  std::vector<double> left_, right_;  // A_i H_i, B_i H_i
};

}  // namespace conebench::solvers
