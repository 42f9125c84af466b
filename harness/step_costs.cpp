#include "harness/step_costs.h"

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "problems/error.h"

namespace conebench::harness {

std::filesystem::path simulations_folder(const std::filesystem::path& results_dir) {
  return results_dir / "simulations";
}

std::vector<results::SceneCost> read_scene_costs(const std::filesystem::path& results_dir) {
  const auto folder = simulations_folder(results_dir);
  if (!std::filesystem::is_directory(folder)) return {};
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<results::SceneCost> costs;
  for (const auto& file : files) {
    std::ifstream in(file);
    const auto summary = nlohmann::json::parse(in, nullptr, false);
    problems::require(summary.is_object(), file.string(),
                      "is no JSON object, expected what `conebench simulate --json` prints");
    costs.push_back(results::scene_cost_from_json(summary, file.string()));
  }
  return costs;
}

}  // namespace conebench::harness
