#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace conebench::harness {

/// Simulates a built-in scene with a solver variant for `steps` steps and writes every `stride`-th
/// from `first` on as a problem file in `folder`. Returns the files. At each step the solver may
/// use the scene's tolerance and time limit.
std::vector<std::filesystem::path> export_scene(const std::string& scene, int steps, int first,
                                                int stride, double budget_s,
                                                const std::string& variant,
                                                const std::filesystem::path& folder);

/// Writes the small_recipes() as problem files in `folder`. Returns the files.
std::vector<std::filesystem::path> write_small_problems(const std::filesystem::path& folder);

}  // namespace conebench::harness
