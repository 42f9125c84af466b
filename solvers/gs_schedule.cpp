#include "solvers/gs_schedule.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace conebench::solvers {

using problems::Problem;

SweepSchedule::SweepSchedule(const Problem& problem, int partial_sweeps, bool islands)
    : partial_sweeps_(partial_sweeps), share_(islands ? kIslandShare : kRestingShare) {
  const auto cones = static_cast<std::size_t>(problem.cone_count());
  if (partial_sweeps_ > 0) changes_.resize(cones);
  if (islands) {
    for (const problems::Island& island : problem.islands()) {
      group_begin_.push_back(static_cast<int>(order_.size()));
      order_.insert(order_.end(), island.cones.begin(), island.cones.end());
    }
  } else {
    order_.resize(cones);
    std::iota(order_.begin(), order_.end(), 0);
    if (partial_sweeps_ > 0) group_begin_ = order_;
  }
  group_begin_.push_back(static_cast<int>(cones));
  restart();
}

void SweepSchedule::restart() {
  sweeps_since_full_ = partial_sweeps_;
  std::fill(changes_.begin(), changes_.end(), std::numeric_limits<double>::infinity());
}

std::span<const int> SweepSchedule::next() {
  full_ = sweeps_since_full_ >= partial_sweeps_;
  if (!full_) pick_moving();
  full_ = full_ || moving_.empty();
  sweeps_since_full_ = full_ ? 0 : sweeps_since_full_ + 1;
  return full_ ? order_ : moving_;
}

double SweepSchedule::largest_change() const {
  return changes_.empty() ? 0.0 : *std::max_element(changes_.begin(), changes_.end());
}

void SweepSchedule::pick_moving() {
  const double threshold = share_ * largest_change();
  moving_.clear();
  for (std::size_t g = 0; g + 1 < group_begin_.size(); ++g) {
    const auto begin = order_.begin() + group_begin_[g], end = order_.begin() + group_begin_[g + 1];
    const bool moves = std::any_of(
        begin, end, [&](int i) { return changes_[static_cast<std::size_t>(i)] > threshold; });
    if (moves) moving_.insert(moving_.end(), begin, end);
  }
}

}  // namespace conebench::solvers
