#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <vector>

#include "results/block.h"
#include "results/group_numbers.h"
#include "results/plot.h"

namespace conebench::results {

/// What the steps of a scene cost beside the solver, from a run of its engine.
struct SceneCost {
  std::string family;  ///< "dem/column-dry", as in ProblemId
  std::int64_t steps = 0;
  double solve_s = 0.0, other_s = 0.0;  ///< of all steps: in the solver, and in the rest
  std::string solver;                   ///< that the run used

  double other_per_step_s() const { return other_s / static_cast<double>(steps); }
};

/// From the object that `conebench simulate --json` prints. Throws problems::InputError naming
/// `where` when a member is missing, or when the run made no step.
SceneCost scene_cost_from_json(const nlohmann::json& summary, const std::string& where);

/// Does the solver matter? For each scene of the group that has a cost, the share of a step that
/// each solver would take (its median time on the scene's problems over that and the rest of the
/// step), and how long the step would be: at the loosest and at the tightest of the group's
/// tolerances (one id). A solver that fails on half of a scene has no dot there.
std::vector<Plot> step_plots(const GroupNumbers& numbers, std::span<const SceneCost> costs);

/// The rest of the step, the quickest and the slowest solver, at the loosest tolerance. Empty where
/// the plots have no row.
Block step_block(const GroupNumbers& numbers, std::span<const SceneCost> costs);

}  // namespace conebench::results
