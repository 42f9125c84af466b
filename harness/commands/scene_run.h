#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "harness/engine.h"

namespace conebench::harness {

/// What simulate and export are asked alike.
struct SceneRun {
  std::string scene;
  std::vector<std::string> overrides;
  EngineOptions engine;
  std::int64_t steps = 0;  ///< 0: the scene's duration
};

/// From now on memory that a step frees is kept for the next, instead of going back to the system.
void keep_freed_memory();

void add_scene_options(CLI::App& verb, SceneRun& run);

std::unique_ptr<Engine> make_engine(const SceneRun& run);

/// How far an engine has come on its way from where it is now. Keeps a reference to it.
class Course {
 public:
  Course(const Engine& engine, const SceneRun& run);

  bool done() const;
  double share() const;  ///< from 0 to 1, of the steps or else of the time
  /// Steps of step_s on the way; mpm may make more.
  std::int64_t planned_steps() const;

 private:
  const Engine& engine_;
  std::int64_t steps_, first_step_;
  double start_s_;
};

}  // namespace conebench::harness
