#pragma once

#include <optional>
#include <span>
#include <vector>

#include "solvers/blocked_rows.h"

namespace conebench::solvers {

/// Products with W for methods that do little else: W = B B^T with B = H F, F F^T = M^-1, where M
/// is block diagonal; the blocks of W where it is given; else those of problems::Problem. Same
/// values as theirs but for rounding. Cost  one pass over the blocks of B each way, or over those
/// of W, without allocation. Memory  that of BlockedRows, and one entry a dof; or that of
/// BlockedDelassus, and one entry a row.
class DelassusProduct {
 public:
  /// `problem` must outlive it.
  explicit DelassusProduct(const problems::Problem& problem);

  /// Wr = W r.
  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& Wr);
  /// u = W r + q.
  void rate(const Eigen::VectorXd& r, Eigen::VectorXd& u);

  /// Whether products of some cones alone cost no more than those cones' share.
  bool has_parts() const { return rows_ || W_; }
  /// u = W r + q of the cones `to`, where all but the cones `from` have r_i = 0; r and u hold their
  /// parts one after another. Precondition: has_parts(); u has the size of its parts.
  void rate(std::span<const int> from, const Eigen::VectorXd& r, std::span<const int> to,
            Eigen::VectorXd& u);

  /// Of one product, roughly (Iteration::work_s).
  double work_s() const;

 private:
  void apply(std::span<const int> from, const Eigen::VectorXd& r, std::span<const int> to,
             const Eigen::VectorXd* q, Eigen::VectorXd& u);

  const problems::Problem& problem_;
  std::optional<BlockedRows> rows_;   // where M is block diagonal
  std::optional<BlockedDelassus> W_;  // where it is given
  std::vector<int> all_;              // cones, in both cases
  Eigen::VectorXd y_;                 // B^T r, or r
};

}  // namespace conebench::solvers
