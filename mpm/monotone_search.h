#pragma once

#include <Eigen/Core>
#include <set>
#include <vector>

#include "mpm/cohesion_law.h"

namespace conebench::mpm {

/// What one solve with frozen states says, one entry a node.
struct FrozenSolution {
  Eigen::VectorXd reaction;  ///< r_n, unshifted [force_unit]
  Eigen::VectorXd rate;      ///< (B v)_0, without w [rate_unit]
  Eigen::VectorXd mobility;  ///< lambda [rate_unit / force_unit]
  double tol_rate = 0.0;     ///< 10 eta U of the solve [rate_unit]
};

/// Looks for states of the under-dense cohesive nodes that agree with the solution they lead to:
///
///   bonded -> loose   if r_n > tol_rate / lambda   (it pushes although it is not dense)
///   loose -> bonded   if (B v)_0 >= -tol_rate      (it is about to dilate)
///
/// For mu = 0 this is the maximal monotone law  r_n >= 0 at rate -g;  0 on (-g, 0);  in
/// [-kappa, 0] at 0;  -kappa above. At first all disagreeing nodes change at once, later
/// those that disagree most; when that set of states has been tried before, only the first of them
/// does (Murty's least index, finite for mu = 0; with friction nothing is guaranteed). The states
/// with the least violation are kept.
///
///   MonotoneSearch search(start, changeable);
///   do { solve with search.states(); if (search.take(solution)) keep it; } while (!search.done());
class MonotoneSearch {
 public:
  static constexpr int kMostSolves = 30;
  /// After so many solves only nodes that disagree by this share of the worst one change.
  static constexpr int kWholeSolves = 3;
  static constexpr double kWorstShare = 0.5;

  /// `may_change` of a node: under-dense and cohesive.
  MonotoneSearch(std::vector<NodeState> start, std::vector<bool> may_change);

  const std::vector<NodeState>& states() const { return states_; }

  /// True when no states so far disagreed less with their own solution: keep this one.
  bool take(const FrozenSolution& solution);

  bool done() const { return done_; }
  /// What ended it: no disagreement is left; every next set of states had been tried; kMostSolves.
  bool agreed() const { return done_ && least_violation_ == 0.0; }
  bool cycled() const { return cycled_; }
  int solves() const { return solves_; }
  /// Largest disagreement of the kept states, as a rate. [rate_unit]
  double violation() const { return least_violation_; }

 private:
  double disagreement(const FrozenSolution& solution, int node) const;

  std::vector<NodeState> states_;
  std::vector<bool> may_change_;
  std::set<std::vector<NodeState>> tried_;
  double least_violation_ = 0.0;
  int solves_ = 0;
  bool done_ = false, cycled_ = false;
};

}  // namespace conebench::mpm
