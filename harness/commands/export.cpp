#include <fmt/format.h>

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

int export_steps(const ExportOptions& options) {
  const std::string policy =
      options.every > 0 ? "every:" + std::to_string(options.every) : options.policy;
  const engine::StepSelection selection = engine::parse_selection(policy);
  const std::unique_ptr<Engine> engine = make_engine(options.run);
  engine->export_to(options.folder, selection);

  catch_interrupts();
  const Course course(*engine, options.run);
  while (!course.done() && !interrupted()) engine->step();

  const auto [written, without_cones] = engine->exported();
  fmt::print("{} problems of {} steps in {} ({} selected steps had no contact)\n", written,
             engine->steps(), options.folder, without_cones);
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
  verb->add_option("-o,--output", options->folder, "Folder for <scene>_<step>.h5")->required();
  CLI::Option* every = verb->add_option("--every", options->every, "Write every N-th step")
                           ->check(CLI::PositiveNumber);
  verb->add_option("--policy", options->policy, "Which steps: all, every:N or N..M")
      ->capture_default_str()
      ->excludes(every);
  verb->callback([options, &exit_code] { exit_code = export_steps(*options); });
}

}  // namespace conebench::harness
