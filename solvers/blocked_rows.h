#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "problems/problem.h"
#include "problems/scaled_rows.h"

namespace conebench::solvers {

/// The rows of H F cone by cone, as dense blocks over runs of consecutive dofs, where F F^T = M^-1
/// (problems::Inertia::inverse_root). In mass-scaled velocities y, v = F y:
///
///   u_i = B_i y + w_i,   y = F^T f + sum_i B_i^T r_i,   W_ii = B_i B_i^T,
///
/// so that one block, read once, serves both directions of a Gauss-Seidel update.
///
/// A run is `run_length` dofs starting at a multiple of run_length (6 for 3D rigid bodies, 2 or 3
/// for grid nodes); the length is the one of {6, 3, 2, 1} that needs the fewest bytes.
/// Memory  8 d run_length + 4 bytes per cone and run. Precondition: M is block diagonal.
class BlockedRows {
 public:
  explicit BlockedRows(const problems::Problem& problem);

  int run_length() const { return run_length_; }
  /// Length of y: dofs, rounded up to whole runs.
  int scaled_dofs() const { return scaled_dofs_; }

  /// First dof of each run of cone i.
  std::span<const int> runs(int i) const {
    const auto first = run_begin_[static_cast<std::size_t>(i)];
    return {run_start_.data() + first, run_begin_[static_cast<std::size_t>(i) + 1] - first};
  }
  /// The cone's blocks, one after another in the order of runs(i): dim x run_length, row-major.
  const double* blocks(int i) const {
    return values_.data() + value_begin_[static_cast<std::size_t>(i)];
  }

  Eigen::MatrixXd diagonal_block(int i, int dim) const;

  /// y for reactions r: F^T f + sum_i B_i^T r_i.
  Eigen::VectorXd scaled_velocity(const problems::Problem& problem, const Eigen::VectorXd& r) const;

  /// Numbers in all blocks.
  double entries() const { return static_cast<double>(values_.size()); }
  /// Bytes of the blocks and their indices.
  std::size_t bytes() const;

 private:
  void append_blocks(const problems::ScaledRows& rows, std::span<const int> runs);

  int run_length_ = 1;
  int scaled_dofs_ = 0;
  std::vector<std::size_t> run_begin_, value_begin_;
  std::vector<int> run_start_;
  std::vector<double> values_;
};

/// Products with one of those blocks, D = dim at compile time or Eigen::Dynamic, L = run_length; x
/// has dim entries, y points to the run's L.
///
/// y += B^T x. The sum before y: the next cone often adds to the same y.
template <int D, int L, class Vector>
void add_transposed_product(const double* block, const Vector& x, double* y) {
  if constexpr (L == 1) {
    *y += x.dot(Eigen::Map<const Eigen::Matrix<double, D, 1>>(block, x.size()));
  } else {
    using Run = Eigen::Matrix<double, L, 1>;
    Run sum = x(0) * Eigen::Map<const Run>(block);
    if constexpr (D == Eigen::Dynamic) {
      for (Eigen::Index row = 1; row < x.size(); ++row) {
        sum += x(row) * Eigen::Map<const Run>(block + row * L);
      }
    } else {
      [&]<int... above>(std::integer_sequence<int, above...>) {
        ((sum += x(above + 1) * Eigen::Map<const Run>(block + (above + 1) * L)), ...);
      }
      (std::make_integer_sequence<int, D - 1>());
    }
    Eigen::Map<Run>(y) += sum;
  }
}

/// x += B y.
template <int D, int L, class Vector>
void add_product(const double* block, const double* y, Vector& x) {
  using Block = Eigen::Matrix<double, D, L, (D == 1 || L > 1) ? Eigen::RowMajor : Eigen::ColMajor>;
  x.noalias() += Eigen::Map<const Block>(block, x.size(), L) *
                 Eigen::Map<const Eigen::Matrix<double, L, 1>>(y);
}

/// W cone by cone as dense blocks, columns increasing, for the Delassus form.
/// Memory  8 d_i d_j + 8 bytes per block.
class BlockedDelassus {
 public:
  /// Assembles W (problems::Problem::delassus) where the problem does not hold it already.
  explicit BlockedDelassus(const problems::Problem& problem);

  struct Entry {
    int row;  ///< first row of cone j in r
    int dim;  ///< of cone j
  };

  std::span<const Entry> entries(int i) const {
    const auto first = entry_begin_[static_cast<std::size_t>(i)];
    return {entries_.data() + first, entry_begin_[static_cast<std::size_t>(i) + 1] - first};
  }
  /// Blocks W_ij in the order of entries(i): d_i x d_j, row-major.
  const double* blocks(int i) const {
    return values_.data() + value_begin_[static_cast<std::size_t>(i)];
  }

  Eigen::MatrixXd diagonal_block(const problems::Problem& problem, int i) const;

 private:
  std::vector<std::size_t> entry_begin_, value_begin_;
  std::vector<Entry> entries_;
  std::vector<double> values_;
};

}  // namespace conebench::solvers
