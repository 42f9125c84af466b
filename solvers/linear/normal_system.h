#pragma once

#include "solvers/block_diagonal.h"

namespace conebench::solvers {

/// Solves (I + E W) x = b for a symmetric positive semidefinite block diagonal E: the linear system
/// of every method whose Newton matrix is symmetric (augmented Lagrangian, interior point).
///
/// Primal form, W = H M^-1 H^T: with y = (M + H^T E H)^-1 H^T b, x = b - E H y. The matrix is
/// positive definite of size dofs whatever the rank of W, and its pattern never changes.
/// Reduced form: with G = E^(1/2), x = b - G (I + G W G)^-1 G W b, of W the blocks on
/// and below the diagonal, mirrored.
///
/// Cost    construction analyses the pattern; factorize() one sparse Cholesky.
class NormalSystem {
 public:
  explicit NormalSystem(const problems::Problem& problem);
  ~NormalSystem();

  /// False when a pivot is not positive: E is too large for doubles, or W is not PSD.
  bool factorize(const BlockDiagonal& E);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;
  /// W x of that x, so that x = b - E W x. Primal form: cheaper than solve() and a product with W.
  Eigen::VectorXd solve_rate(const Eigen::VectorXd& b) const;

  /// The same with E = R^T R for a given root: solves (I + R W R^T) y = z, in which nothing cancels
  /// however large or small the scalings are. (I + E W) x = b is then x = b - R^T y, R W b = z.
  bool factorize_root(const BlockDiagonal& R);
  Eigen::VectorXd solve_root(const Eigen::VectorXd& z) const;
  /// W R^T y of that y. Primal form: cheaper than solve_root().
  Eigen::VectorXd solve_root_rate(const Eigen::VectorXd& z) const;

  /// Of factorize() and a few solve() (Iteration::work_s).
  double work_s() const;

  /// Nonzeros of the lower triangle of M + H^T E H, to compare with another form's. Primal only.
  static std::int64_t nonzeros(const problems::Problem& problem);

 private:
  struct Primal;
  struct Reduced;
  std::unique_ptr<Primal> primal_;
  std::unique_ptr<Reduced> reduced_;
};

}  // namespace conebench::solvers
