#pragma once

#include <filesystem>
#include <vector>

#include "results/step_share.h"

namespace conebench::harness {

/// RESULTS_DIR/simulations: one file a scene, as `conebench simulate SCENE --json` prints it.
std::filesystem::path simulations_folder(const std::filesystem::path& results_dir);

/// What these files say of steps, in the order of their names; nothing without the folder. Throws
/// problems::InputError naming the file that is no such summary.
std::vector<results::SceneCost> read_scene_costs(const std::filesystem::path& results_dir);

}  // namespace conebench::harness
