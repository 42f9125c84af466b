#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "results/block.h"
#include "results/group.h"
#include "results/plot.h"
#include "results/profiles.h"

namespace conebench::results {

/// What a solver gains from starting at an answer instead of at r = 0.
struct WarmGain {
  std::string solver;                    ///< contender, with its donor
  int both = 0;                          ///< problems solved from either start
  int cold_solved = 0, warm_solved = 0;  ///< of the problems run from both
  std::optional<double> gain{};  ///< geometric mean of cold time over warm time; nothing: none
  std::optional<Interval> interval{};  ///< 95 %, over scenes
};

/// The group that differs from `warm` only in that it starts from r = 0; nullptr: none.
const Group* cold_twin(const Group& warm, std::span<const Group> groups);

/// One entry a contender of `warm` that `cold` has too, in alphabetical order. The first step of a
/// sequence, which starts cold itself, is left out.
std::vector<WarmGain> warm_gains(const Group& cold, const Group& warm);

/// In the order and style of the ranking.
Plot warm_plot(std::span<const WarmGain> gains, std::span<const Rank> ranking);
Block warm_block(std::span<const WarmGain> gains, const Settings& warm);

}  // namespace conebench::results
