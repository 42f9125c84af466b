#pragma once

#include "solvers/block_diagonal.h"

namespace conebench::solvers {

/// Solves (I + R W R^T) y = z for block diagonal R, W = H M^-1 H^T, through the quasidefinite
/// matrix [M, H^T R^T; R H, -I], which has an LDL^T factor in any order. Sparser than
/// M + H^T R^T R H where cones touch many dofs. Primal form only.
/// Source  Vanderbei, SIAM J. Optim. 5(1) (1995) 100-113 (not checked).
class KktSystem {
 public:
  explicit KktSystem(const problems::Problem& problem);
  ~KktSystem();

  /// False when the factorisation fails.
  bool factorize(const BlockDiagonal& R);
  Eigen::VectorXd solve(const Eigen::VectorXd& z) const;

  /// Of factorize() and a few solve() (Iteration::work_s); 0 before the first.
  double work_s() const;

  /// Nonzeros of the lower triangle, to compare with another form's.
  static std::int64_t nonzeros(const problems::Problem& problem);

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace conebench::solvers
