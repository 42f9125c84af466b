#include "mpm/monotone_search.h"

#include <algorithm>
#include <limits>

namespace conebench::mpm {
namespace {

NodeState other(NodeState state) {
  return state == NodeState::kBonded ? NodeState::kLoose : NodeState::kBonded;
}

}  // namespace

MonotoneSearch::MonotoneSearch(std::vector<NodeState> start, std::vector<bool> may_change)
    : states_(std::move(start)),
      may_change_(std::move(may_change)),
      least_violation_(std::numeric_limits<double>::infinity()) {}

// By how much a node's state contradicts the solution, as a rate; 0: it agrees.
double MonotoneSearch::disagreement(const FrozenSolution& solution, int node) const {
  const auto slot = static_cast<std::size_t>(node);
  if (!may_change_[slot]) return 0.0;
  const double excess = states_[slot] == NodeState::kBonded
                            ? solution.mobility[node] * solution.reaction[node]
                            : solution.rate[node] + 2.0 * solution.tol_rate;
  return excess > solution.tol_rate ? excess : 0.0;
}

bool MonotoneSearch::take(const FrozenSolution& solution) {
  ++solves_;
  tried_.insert(states_);
  std::vector<double> excess(states_.size());
  for (std::size_t i = 0; i < states_.size(); ++i) {
    excess[i] = disagreement(solution, static_cast<int>(i));
  }
  const double violation = excess.empty() ? 0.0 : *std::max_element(excess.begin(), excess.end());
  const double share = solves_ <= kWholeSolves ? 0.0 : kWorstShare * violation;
  std::vector<std::size_t> wrong;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (excess[i] > 0.0 && excess[i] >= share) wrong.push_back(i);
  }
  const bool best = violation < least_violation_;
  if (best) least_violation_ = violation;
  if (wrong.empty() || solves_ == kMostSolves) {
    done_ = true;
    return best;
  }
  std::vector<NodeState> next = states_;
  for (const std::size_t i : wrong) next[i] = other(next[i]);
  if (tried_.contains(next)) {
    next = states_;
    next[wrong.front()] = other(next[wrong.front()]);
  }
  done_ = cycled_ = tried_.contains(next);
  states_ = std::move(next);
  return best;
}

}  // namespace conebench::mpm
