#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "harness/commands/commands.h"
#include "harness/commands/scene_run.h"
#include "harness/interrupt.h"

namespace conebench::harness {
namespace {

struct ExportOptions {
  SceneRun run;
  std::string folder;
  std::string policy = "all";
  std::int64_t every = 0;
};

std::string describe(const engine::ExportCost& cost, double run_s) {
  return fmt::format(
      "exporting held the engine for {:.3g} s of {:.3g} s ({:.2g} %); it waited {} times for the "
      "writer, {:.3g} s",
      cost.total_s, run_s, 100.0 * cost.total_s / run_s, cost.waits, cost.waited_s);
}

int export_steps(const ExportOptions& options) {
  const std::string policy =
      options.every > 0 ? "every:" + std::to_string(options.every) : options.policy;
  const engine::StepSelection selection = engine::parse_selection(policy);
  const std::unique_ptr<Engine> engine = make_engine(options.run);
  engine->export_to(options.folder, selection);

  catch_interrupts();
  const auto start = std::chrono::steady_clock::now();
  const Course course(*engine, options.run);
  while (!course.done() && !interrupted()) engine->step();
  const Exported exported = engine->finish_export();
  const std::chrono::duration<double> run = std::chrono::steady_clock::now() - start;

  fmt::print("{} problems of {} steps in {} ({} selected steps had no contact)\n{}\n",
             exported.files.size(), engine->steps(), options.folder, exported.without_cones,
             describe(exported.cost, run.count()));
  if (const auto failed = engine->unconverged_steps()) {
    fmt::print(stderr, "conebench: {} steps did not converge to {:g}\n", failed,
               engine->scene().solver.tol);
  }
  return interrupted() ? kInterruptedExit : 0;
}

}  // namespace

void add_export(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ExportOptions>();
  CLI::App* verb = app.add_subcommand("export", "Run a scene and write its cone problems");
  add_scene_options(*verb, options->run);
  verb->add_option("-o,--output", options->folder, "Folder for <scene>_<step>.h5")
      ->type_name("DIR")
      ->required();
  CLI::Option* every = verb->add_option("--every", options->every, "Write every N-th step")
                           ->check(CLI::PositiveNumber);
  verb->add_option("--policy", options->policy,
                   "Which steps: all, every:N, N..M, hardest:K, reservoir:K or stratified:K")
      ->type_name("all|every:N|N..M|hardest:K|reservoir:K|stratified:K")
      ->capture_default_str()
      ->excludes(every);
  verb->callback([options, &exit_code] { exit_code = export_steps(*options); });
}

}  // namespace conebench::harness
