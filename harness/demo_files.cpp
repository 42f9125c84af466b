#include "harness/demo_files.h"

#include <chrono>

#include "harness/engine.h"
#include "harness/small_problems.h"
#include "problems/problem_file.h"
#include "results/output.h"

namespace conebench::harness {

std::vector<std::filesystem::path> export_scene(const SceneExport& wanted, double budget_s,
                                                const std::string& variant,
                                                const std::filesystem::path& folder,
                                                const std::filesystem::path& summary) {
  const std::unique_ptr<Engine> engine = make_engine(
      engine::with_overrides(find_scene(wanted.scene), wanted.overrides), {.solver = variant});
  engine->export_to(folder, {.first = wanted.first, .stride = wanted.stride});
  const auto start = std::chrono::steady_clock::now();
  const std::chrono::duration<double> budget(budget_s);
  while (engine->steps() < wanted.steps && std::chrono::steady_clock::now() - start < budget) {
    engine->step();
  }
  results::write_text_file(summary, engine->summary().dump(2) + "\n");
  return engine->finish_export().files;
}

std::vector<std::filesystem::path> write_small_problems(const std::filesystem::path& folder) {
  results::make_folder(folder);
  std::vector<std::filesystem::path> files;
  for (const NamedRecipe& named : small_recipes()) {
    files.push_back(folder / (named.name + ".h5"));
    problems::write_problem_file(files.back(), {make_named(named), {}, {}, {}});
  }
  return files;
}

}  // namespace conebench::harness
