#pragma once

#include "solvers/block_diagonal.h"
#include "solvers/linear/cone_rows.h"
#include "solvers/linear/lu.h"

namespace conebench::solvers {

/// Solves (I + S C W S^T) y = z of linear/scaled_system.h in the primal form, for any block
/// diagonal S and C:
///
///   (M + H^T S^T S C H) x = H^T S^T z,   y = z - S C H x,
///
/// whose matrix, of size dofs, is not symmetric but has the pattern of the symmetric one (C = I).
/// On grids its LU costs a third of that of the whole (linear/general_system.h); as normal
/// equations do, it loses what scalings, very large and very small, make cancel. Pattern analysed
/// once.
class SlidingSystem {
 public:
  /// Precondition: a primal problem.
  explicit SlidingSystem(const problems::Problem& problem);

  /// False when the matrix is singular to working precision; solve() must not be called then.
  bool factorize(const BlockDiagonal& S, const BlockDiagonal& SC);
  Eigen::VectorXd solve(const Eigen::VectorXd& z) const;

  /// Of the last factorize() and a few solve() (Iteration::work_s); 0 before it.
  double work_s() const { return lu_.work_s(); }

 private:
  const problems::Problem& problem_;
  ConeRows rows_;
  BlockDiagonal S_, SC_;
  ConeRows::Matrix mass_, matrix_;
  Lu lu_;
};

}  // namespace conebench::solvers
