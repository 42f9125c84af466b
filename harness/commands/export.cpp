#include <fmt/format.h>

#include <memory>

#include "dem/export.h"
#include "dem/simulation.h"
#include "harness/commands/commands.h"
#include "harness/interrupt.h"
#include "harness/step_solver.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

struct ExportOptions {
  std::string scene, folder, solver;
  std::string policy = "all";
  std::int64_t every = 0;
  std::int64_t steps = 0;
};

int export_steps(const ExportOptions& options) {
  const dem::Scene scene = dem::load_scene(options.scene);
  const std::string policy =
      options.every > 0 ? "every:" + std::to_string(options.every) : options.policy;
  dem::Exporter exporter(options.folder, engine::parse_selection(policy));
  const std::string solver = options.solver.empty() ? scene.solver.name : options.solver;
  dem::Simulation simulation(scene,
                             make_step_solver(solver, scene.solver.tol, scene.solver.time_limit_s,
                                              scene.solver.max_iterations));
  simulation.add_observer(std::ref(exporter));

  catch_interrupts();
  const std::int64_t steps = options.steps > 0 ? options.steps : scene.step_count();
  while (simulation.summary().steps < steps && !interrupted()) simulation.step();

  fmt::print("{} problems of {} steps in {} ({} selected steps had no contact)\n",
             exporter.written(), simulation.summary().steps, options.folder,
             exporter.without_contacts());
  if (const auto failed = simulation.summary().unconverged_steps) {
    fmt::print(stderr, "conebench: {} steps did not converge to {:g}\n", failed, scene.solver.tol);
  }
  return interrupted() ? kInterruptedExit : 0;
}

}  // namespace

void add_export(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* verb = app.add_subcommand("export", "Run a scene and write its cone problems");
  verb->add_option("SCENE", options->scene, "Built-in name or .toml file")->required();
  verb->add_option("-o,--output", options->folder, "Folder for <scene>_<step>.h5")->required();
  CLI::Option* every = verb->add_option("--every", options->every, "Write every N-th step")
                           ->check(CLI::PositiveNumber);
  verb->add_option("--policy", options->policy, "Which steps: all, every:N or N..M")
      ->capture_default_str()
      ->excludes(every);
  verb->add_option("--steps", options->steps, "Steps to run (default: the scene's duration)")
      ->check(CLI::PositiveNumber);
  verb->add_option("-s,--solver", options->solver, "Step solver (default: the scene's)");
  verb->callback([options, &exit_code] { exit_code = export_steps(*options); });
}

}  // namespace conebench::harness
