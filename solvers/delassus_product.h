#pragma once

#include "problems/problem.h"

namespace conebench::solvers {

/// Products with W for methods that do little else: W = B B^T with B = H F, F F^T = M^-1, where M
/// is block diagonal; else those of problems::Problem. Same values as theirs but for rounding. Cost
/// one pass over B each way, without allocation where M is block diagonal or W is given. Memory  12
/// bytes a nonzero of B, and one entry a dof.
class DelassusProduct {
 public:
  /// `problem` must outlive it.
  explicit DelassusProduct(const problems::Problem& problem);

  /// Wr = W r.
  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& Wr);
  /// u = W r + q.
  void rate(const Eigen::VectorXd& r, Eigen::VectorXd& u);

 private:
  const problems::Problem& problem_;
  problems::SparseMatrix B_;  // empty, and y_, unless M is block diagonal
  Eigen::VectorXd y_;         // B^T r
};

}  // namespace conebench::solvers
