#include "harness/demo_files.h"

#include <chrono>

#include "dem/export.h"
#include "dem/simulation.h"
#include "harness/small_problems.h"
#include "harness/step_solver.h"
#include "problems/problem_file.h"
#include "results/output.h"

namespace conebench::harness {

std::vector<std::filesystem::path> export_scene(const std::string& scene, int steps, int first,
                                                int stride, double budget_s,
                                                const std::string& variant,
                                                const std::filesystem::path& folder) {
  const dem::Scene loaded = dem::load_scene(scene);
  std::vector<std::filesystem::path> files;
  dem::Simulation simulation(
      loaded, make_step_solver(variant, loaded.solver.tol, loaded.solver.time_limit_s,
                               loaded.solver.max_iterations));
  dem::Exporter exporter(folder, {.first = first, .stride = stride});
  simulation.add_observer([&](const dem::StepView& view) {
    const auto before = exporter.written();
    exporter(view);
    if (exporter.written() == before) return;
    files.push_back(folder / (view.problem->name() + ".h5"));
  });
  const auto start = std::chrono::steady_clock::now();
  const std::chrono::duration<double> budget(budget_s);
  while (simulation.summary().steps < steps && std::chrono::steady_clock::now() - start < budget) {
    simulation.step();
  }
  return files;
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
