#pragma once

#include <Eigen/SparseCore>
#include <memory>

namespace conebench::solvers {

/// Sparse LU of square matrices that share one, nearly symmetric, pattern: UMFPACK where
/// SuiteSparse's GPL parts are built in (ordered for such a pattern, pivots preferably on the
/// diagonal), else Eigen's SparseLU.
class Lu {
 public:
  using Matrix = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;

  Lu();
  ~Lu();
  Lu(Lu&&) noexcept;

  /// Orders and analyses once.
  void analyse(const Matrix& matrix);
  /// False when the matrix is singular to working precision. `matrix` must live until the last
  /// solve().
  bool factorize(const Matrix& matrix);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  /// Of the last factorize() and a few solve() (Iteration::work_s); 0 before it.
  double work_s() const { return work_s_; }

 private:
  struct Factor;
  std::unique_ptr<Factor> factor_;
  double work_s_ = 0.0;
};

}  // namespace conebench::solvers
