#include "harness/commands/scene_run.h"

#include <malloc.h>

#include <limits>

namespace conebench::harness {
namespace {

// A step's arrays are about as large as those of the step before: their pages are kept, since to
// get them anew from the system takes a fifth of a step of 12 000 contacts.
void keep_freed_memory() {
  constexpr int kLargestKept = 32 << 20;  // the most that glibc takes
  mallopt(M_MMAP_THRESHOLD, kLargestKept);
  mallopt(M_TRIM_THRESHOLD, std::numeric_limits<int>::max());
}

}  // namespace

void add_scene_options(CLI::App& verb, SceneRun& run) {
  verb.add_option("SCENE", run.scene, "Built-in name or .toml file")->type_name("")->required();
  verb.add_option("-s,--solver", run.engine.solver, "Step solver (default: the scene's)")
      ->type_name("SOLVER");
  verb.add_option("--set", run.overrides,
                  "Another value of the scene, such as material.friction=0.5")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  verb.add_option("--steps", run.steps, "Steps to run (default: the scene's duration)")
      ->check(CLI::PositiveNumber);
}

std::unique_ptr<Engine> make_engine(const SceneRun& run) {
  keep_freed_memory();
  return make_engine(engine::with_overrides(find_scene(run.scene), run.overrides), run.engine);
}

Course::Course(const Engine& engine, const SceneRun& run)
    : engine_(engine), steps_(run.steps), first_step_(engine.steps()), start_s_(engine.time_s()) {}

bool Course::done() const {
  return steps_ > 0 ? engine_.steps() - first_step_ >= steps_ : engine_.finished();
}

double Course::share() const {
  if (done()) return 1.0;
  if (steps_ > 0) {
    return static_cast<double>(engine_.steps() - first_step_) / static_cast<double>(steps_);
  }
  return (engine_.time_s() - start_s_) / (engine_.scene().duration_s - start_s_);
}

std::int64_t Course::planned_steps() const {
  return steps_ > 0 ? steps_ : engine_.scene().step_count();
}

}  // namespace conebench::harness
