#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "harness/commands/commands.h"
#include "harness/commands/scene_run.h"
#include "harness/interrupt.h"
#include "problems/engine/text_file.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

// ParaView needs a film, not every step.
constexpr std::int64_t kVtkFiles = 100;

struct SimulateOptions {
  SceneRun run;
  std::string restart;
  std::filesystem::path folder;
  std::int64_t frames = 0;
  std::int64_t checkpoint_every = 0;
  bool json = false;
};

// Takes `count` pictures, the first of the start and the last of the end.
class Film {
 public:
  Film(Engine& engine, std::int64_t count) : engine_(engine), count_(count) {}

  void look(double share) {
    if (taken_ >= count_) return;
    const double due =
        count_ == 1 ? 1.0 : static_cast<double>(taken_) / static_cast<double>(count_ - 1);
    if (share < due - 1e-9) return;
    engine_.take_frame();
    ++taken_;
  }

 private:
  Engine& engine_;
  std::int64_t count_, taken_ = 0;
};

void check(const SimulateOptions& options) {
  problems::require(options.frames == 0 || !options.folder.empty(), "--frames",
                    "needs a folder for its pictures, expected -o DIR");
  if (options.checkpoint_every == 0) return;
  problems::require(!options.folder.empty(), "--checkpoint-every",
                    "needs a folder for its files, expected -o DIR");
}

void save_checkpoint(const Engine& engine, const std::filesystem::path& folder) {
  engine.save(folder / fmt::format("checkpoint_{:06}.cbor", engine.steps()));
}

void run_course(Engine& engine, const Course& course, const SimulateOptions& options) {
  Film film(engine, options.frames);
  film.look(0.0);
  catch_interrupts();
  while (!course.done() && !interrupted()) {
    engine.step();
    film.look(course.share());
    if (options.checkpoint_every == 0) continue;
    if (interrupted() || engine.steps() % options.checkpoint_every == 0) {
      save_checkpoint(engine, options.folder);
    }
  }
}

int simulate(const SimulateOptions& options) {
  const std::unique_ptr<Engine> engine = make_engine(options.run);
  check(options);
  if (!options.restart.empty()) engine->restart(options.restart);
  const Course course(*engine, options.run);
  const bool has_output = !options.folder.empty();
  if (has_output) {
    engine->write_output(options.folder,
                         std::max<std::int64_t>(1, course.planned_steps() / kVtkFiles));
  }
  run_course(*engine, course, options);
  if (has_output) {
    engine->finish_output();
    engine->draw_frames(options.folder);
    engine::write_text_file(options.folder / "summary.json", engine->summary().dump(2) + "\n");
  }
  fmt::print("{}", options.json ? engine->summary().dump() + "\n" : engine->summary_text());
  return interrupted() ? kInterruptedExit : 0;
}

}  // namespace

void add_simulate(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<SimulateOptions>();
  CLI::App* verb = app.add_subcommand("simulate", "Run a scene through its engine");
  add_scene_options(*verb, options->run);
  verb->add_option("-o,--output", options->folder,
                   "Folder for ParaView files, summary.json and history.csv (a line a step)")
      ->type_name("DIR");
  verb->add_option("--frames", options->frames, "Also draw N pictures (SVG) in the folder")
      ->check(CLI::PositiveNumber);
  verb->add_option("--colour", options->run.engine.colour,
                   "Of the pictures: speed, or fraction (of volume, mpm)")
      ->type_name("speed|fraction");
  verb->add_option("--checkpoint-every", options->checkpoint_every,
                   "Save the run every N steps as checkpoint_<step>.cbor in the folder")
      ->check(CLI::PositiveNumber);
  verb->add_option("--restart", options->restart, "Go on from a checkpoint of this scene")
      ->type_name("FILE");
  verb->add_flag("--json", options->json, "Print the summary as one JSON object");
  verb->callback([options, &exit_code] { exit_code = simulate(*options); });
}

}  // namespace conebench::harness
