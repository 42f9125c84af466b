#pragma once

#include "solvers/block_diagonal.h"

namespace conebench::solvers {

/// Solves (A + B W) x = b for block diagonal A and B: the Newton systems of methods whose
/// generalised Jacobian is not symmetric.
///
/// kReduced  factorises A + B W itself (rows() unknowns, W assembled).
/// kFull     factorises [M, -H^T; B H, A] (dofs() + rows() unknowns, W never formed). Primal only.
/// kAuto     kFull where it is possible and W has more nonzeros than M, H, H^T and 3 rows()
///           together, or M couples more than one block of dofs, which makes W dense.
/// Pattern analysed once, at construction.
class GeneralSystem {
 public:
  enum class Form { kAuto, kReduced, kFull };

  /// Precondition: a primal problem when `form` is kFull. With `right_scaled` the system is
  /// (A + B W R^T) y = z and factorize() wants R.
  GeneralSystem(const problems::Problem& problem, Form form, bool right_scaled = false);
  ~GeneralSystem();

  /// False when the matrix is singular to working precision; solve() must not be called then.
  bool factorize(const BlockDiagonal& A, const BlockDiagonal& B, const BlockDiagonal* R = nullptr);
  Eigen::VectorXd solve(const Eigen::VectorXd& b) const;

  /// Of the last factorize() and a few solve() (Iteration::work_s); 0 before it.
  double work_s() const;

 private:
  struct Reduced;
  struct Full;
  std::unique_ptr<Reduced> reduced_;
  std::unique_ptr<Full> full_;
};

}  // namespace conebench::solvers
