#pragma once

#include <span>
#include <vector>

#include "solvers/gs_coupling.h"

namespace conebench::solvers {

/// An order of the cones in which many neighbours in the order do not feel each other: what one of
/// them changes, no other of its colour reads. So a colour may be solved by several threads at
/// once, with the same numbers whatever their count.
///
/// Colours are given greedily in the order of the cones, each the first that is free. Colours of
/// fewer than kLeastParallel cones, such as those of a body with very many contacts, are not worth
/// waking a thread: they come last, as one stretch that is solved in sequence.
class Colouring {
 public:
  static constexpr int kLeastParallel = 64;

  /// Two cones clash where they share a run of dofs. Cost: linear in the runs, times colours / 64.
  template <int L>
  Colouring(const problems::Problem& problem, const VelocityCoupling<L>& coupling) {
    arrange(colours_by_runs(problem.cone_count(), coupling.rows()));
  }
  /// Two cones clash where W couples them. Cost: linear in the blocks of W.
  Colouring(const problems::Problem& problem, const DelassusCoupling& coupling);

  /// The cones of one colour, increasing.
  std::span<const std::vector<int>> parallel() const { return parallel_; }
  /// The cones of all small colours.
  std::span<const int> serial() const { return serial_; }

 private:
  static std::vector<int> colours_by_runs(int cones, const BlockedRows& rows);
  void arrange(const std::vector<int>& colour);

  std::vector<std::vector<int>> parallel_;
  std::vector<int> serial_;
};

}  // namespace conebench::solvers
