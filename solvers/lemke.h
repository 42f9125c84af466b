#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

namespace conebench::solvers {

enum class LemkeEnd {
  kSolved,
  kRay,      ///< no variable blocks the entering one: a secondary ray
  kStopped,  ///< `go_on` said so
};

/// Lemke's method for the linear complementarity problem: find z with
///
///   w = M z + q,   w >= 0,   z >= 0,   w.z = 0.
///
/// Complementary pivots on w = q + M z + z_0 (1, ..., 1) from the first z_0 that makes w >= 0,
/// until z_0 leaves. Ties are broken lexicographically, as if q were q + (e, e^2, ...) for a small
/// e, so that no basis comes back in exact arithmetic. Pivots below 1e-11 are taken as 0, and
/// ratios that differ by less than 1e-12 as tied: M and q are to be of order 1.
///
/// With M copositive, as in solvers/pyramid_lcp.h, a ray means that there is a y >= 0 with y.q <=
/// 0, y.(M + M^T) >= 0 that is a candidate for a proof that there is no solution, but not one by
/// itself.
///
/// Cost    a pivot is a rank-one update of N (N + 2) doubles; usually N to 3 N pivots.
/// Source  Cottle, Pang, Stone, The Linear Complementarity Problem (1992), section 4.4 (Lemke),
///         4.9 (lexicographic) (not checked).
class Lemke {
 public:
  /// M is N x N, q has N entries, both finite.
  Lemke(const Eigen::MatrixXd& M, const Eigen::VectorXd& q);

  /// `go_on` is asked before every pivot.
  LemkeEnd solve(const std::function<bool(std::int64_t pivots)>& go_on);

  std::int64_t pivots() const { return pivots_; }
  /// z of the basis reached; a solution after kSolved.
  Eigen::VectorXd z() const;

 private:
  // Variables: w_m is m, z_m is N + m, z_0 is 2 N.
  using Table = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  Eigen::Index size() const { return table_.rows(); }
  Eigen::Index first_row() const;
  Eigen::Index leaving_row(Eigen::Index column) const;
  double perturbation(Eigen::Index row, Eigen::Index power) const;
  void exchange(Eigen::Index row, Eigen::Index column);

  // basic_[i] = table_(i, N + 1) + sum_k table_(i, k) nonbasic_[k], k = 0..N.
  Table table_;
  std::vector<Eigen::Index> basic_, nonbasic_;
  std::vector<Eigen::Index> column_of_;  // of each variable while it is nonbasic; -1
  std::int64_t pivots_ = 0;
};

}  // namespace conebench::solvers
