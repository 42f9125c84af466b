#pragma once

#include <filesystem>
#include <vector>

#include "harness/study.h"

namespace conebench::harness {

/// What a results folder says of its campaign, so that every shard runs the same tasks and nobody
/// reads all problems again: RESULTS_DIR/plan.json.
struct PlanFile {
  Study study;
  std::vector<ProblemSource> problems;
};

std::filesystem::path plan_path(const std::filesystem::path& results_dir);

/// Atomic. Paths of problems become absolute. Throws problems::OutputError.
void write_plan(const std::filesystem::path& results_dir, const PlanFile& plan);

/// Throws problems::InputError when there is none or it is damaged.
PlanFile read_plan(const std::filesystem::path& results_dir);

}  // namespace conebench::harness
