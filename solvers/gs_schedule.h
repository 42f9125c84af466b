#pragma once

#include <span>
#include <vector>

#include "problems/problem.h"

namespace conebench::solvers {

/// Which cones each sweep of Gauss-Seidel visits.
///
/// Between two full sweeps come up to `partial_sweeps` partial ones, which visit only what still
/// moves: of the latest changes of all cones, as rates lambda_i |dr_i|, those above kRestingShare
/// (islands: kIslandShare) of the largest. Without islands that is decided cone by cone; with
/// islands, by the largest change in each connected component, whose cones are then visited one
/// component after another. No tolerance enters: what is skipped waits until the rest has caught
/// up, or for the next full sweep.
class SweepSchedule {
 public:
  static constexpr double kRestingShare = 1e-3;  ///< of cones
  static constexpr double kIslandShare = 0.1;    ///< of islands, which do not feel each other

  SweepSchedule(const problems::Problem& problem, int partial_sweeps, bool islands);

  void restart();

  /// The cones of the next sweep, in order; all of them in a full one.
  std::span<const int> next();
  /// Whether the last sweep handed out was full.
  bool full() const { return full_; }

  /// Where the sweep writes the change of each cone it visits; empty when nobody needs it.
  std::span<double> changes() { return changes_; }
  /// The largest of the latest changes of all cones. Precondition: partial_sweeps > 0.
  double largest_change() const;

 private:
  void pick_moving();

  int partial_sweeps_;
  int sweeps_since_full_ = 0;
  bool full_ = true;
  std::vector<int> order_;        // all cones, island by island
  std::vector<int> group_begin_;  // in order_: islands, or single cones
  double share_;
  std::vector<double> changes_;  // of cone i, latest
  std::vector<int> moving_;
};

}  // namespace conebench::solvers
