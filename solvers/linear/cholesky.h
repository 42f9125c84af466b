#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace conebench::solvers {

/// Sparse Cholesky of symmetric matrices that share one pattern: CHOLMOD (simplicial or supernodal,
/// its own choice) where SuiteSparse's GPL parts are built in, else Eigen's simplicial factor.
class Cholesky {
 public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

  Cholesky();
  ~Cholesky();
  Cholesky(Cholesky&&) noexcept;

  /// Orders and analyses once. Only the lower triangle of `matrix` is read, here and below.
  void analyse(const Matrix& matrix);
  /// False when a pivot is not positive; solve() must not be called then.
  bool factorize(const Matrix& matrix);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  /// Of factorize() and a few solve(), from the analysis (Iteration::work_s).
  double work_s() const;

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
};

}  // namespace conebench::solvers
