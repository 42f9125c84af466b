#pragma once

#include <span>
#include <vector>

#include "problems/sparse.h"

namespace conebench::problems {

/// Rows of H F, a few at a time, as a dense block over the columns that they touch: the whole
/// product is never there. With F F^T = M^-1 (Inertia::inverse_root), S S^T is W_ii for the rows of
/// cone i.
///
/// Cost  linear in the products of nonzeros that the rows need; no allocation once warmed up.
class ScaledRows {
 public:
  /// Both must outlive it.
  ScaledRows(const SparseMatrix& H, const SparseMatrix& F)
      : H_(H), F_(F), slot_(static_cast<std::size_t>(F.cols()), -1) {}

  /// Takes rows [first, first + count) of H.
  void load(int first, int count);

  /// The columns touched, increasing.
  std::span<const int> columns() const { return columns_; }
  /// count x columns().size().
  Eigen::Map<const Eigen::MatrixXd> S() const {
    return {values_.data(), rows_, static_cast<Eigen::Index>(columns_.size())};
  }

 private:
  const SparseMatrix& H_;
  const SparseMatrix& F_;
  int rows_ = 0;
  std::vector<int> columns_;
  std::vector<int> slot_;       // of a touched column in columns_; -1 elsewhere
  std::vector<double> values_;  // column-major
};

}  // namespace conebench::problems
