#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace conebench::harness {

/// Which steps of a built-in scene are exported: every `stride`-th from `first` on.
struct SceneExport {
  std::string scene;
  int steps, first, stride;
  std::vector<std::string> overrides;  ///< other values of the scene, each "PATH=VALUE"
};

/// Simulates the scene with a solver variant, for at most `budget_s` of wall time, and writes the
/// problems in `folder`, and what the run came to in `summary`. Returns the problem files. At each
/// step the solver may use the scene's tolerance and time limit.
std::vector<std::filesystem::path> export_scene(const SceneExport& wanted, double budget_s,
                                                const std::string& variant,
                                                const std::filesystem::path& folder,
                                                const std::filesystem::path& summary);

/// Writes the small_recipes() as problem files in `folder`. Returns the files.
std::vector<std::filesystem::path> write_small_problems(const std::filesystem::path& folder);

}  // namespace conebench::harness
