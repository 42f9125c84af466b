#pragma once

#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "problems/sparse.h"

namespace conebench::problems {

/// The mass matrix M, factorised once and reused for every product with M^-1.
///
/// M's graph falls into connected components (bodies in DEM, dofs in lumped MPM). Components of at
/// most kLargestBlock dofs are inverted exactly; the rest, if any, shares one sparse Cholesky.
///
/// Cost    set-up linear in nnz(M) when block diagonal; solve() is one pass over the factor.
/// Errors  InputError when a pivot is not positive: M must be symmetric positive definite.
class Inertia {
 public:
  static constexpr int kLargestBlock = 12;

  Inertia(const SparseMatrix& M, std::string_view subject);

  /// The same of M_part = M(dofs, dofs), where `dofs`, increasing, hold whole components and
  /// position[dofs[k]] = k. Cost: a copy when block_diagonal(), else as the constructor's.
  Inertia of_part(const SparseMatrix& M_part, std::span<const int> dofs,
                  std::span<const int> position, std::string_view subject) const;
  ~Inertia();
  Inertia(Inertia&&) noexcept;

  /// M^-1 b, for b with one entry a dof.
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  /// True when every component has at most kLargestBlock dofs, stored zeros not counted.
  bool block_diagonal() const { return large_dofs_.empty(); }

  /// F with F F^T = D^-1, where D = M on components of at most kLargestBlock dofs and diag(M) on
  /// the dofs of larger ones. When block_diagonal(), F F^T = M^-1.
  const SparseMatrix& inverse_root() const { return root_; }

  /// Component of each dof, numbered by first dof.
  std::span<const int> component_of() const { return component_of_; }
  int component_count() const { return component_count_; }

 private:
  struct Factor;

  Inertia();

  std::vector<int> component_of_;
  int component_count_ = 0;
  SparseMatrix root_;
  std::vector<int> large_dofs_;
  std::unique_ptr<Factor> factor_;  // of M on large_dofs_; null when block diagonal
};

}  // namespace conebench::problems
