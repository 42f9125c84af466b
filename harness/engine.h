#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "problems/engine/exporter.h"
#include "problems/engine/heap.h"
#include "problems/engine/scene_file.h"
#include "problems/engine/step_selection.h"

namespace conebench::harness {

/// How a scene is run, beyond what it says itself.
struct EngineOptions {
  std::string solver{};  ///< a variant; empty: the scene's
  std::string colour{};  ///< of pictures: "speed", mpm also "fraction"; empty: the engine's first
};

/// The problem files of a run.
struct Exported {
  std::vector<std::filesystem::path> files;  ///< in the order of steps
  std::int64_t without_cones = 0;            ///< selected steps that had no cone, hence no problem
  engine::ExportCost cost;
};

/// What the physics of a run has come to, measured alike in both engines.
struct Snapshot {
  engine::Heap heap;
  double energy_J = 0.0;  ///< kinetic and potential, of all that moves freely; mpm 2D: per metre
  /// How far matter is inside matter [-]. dem: the deepest overlap of all steps, over the mean
  /// radius. mpm: by how much the densest node of all steps is fuller than phi_max, or than it was
  /// at the start where that is more, over phi_max.
  double penetration = 0.0;
  std::int64_t iterations = 0;  ///< of the step solver
  double solve_s = 0.0;         ///< wall clock in the step solver
};

/// A running scene of either engine, as the verbs see it.
///
/// Errors: InputError, OutputError and std::runtime_error as the engines and their writers say.
class Engine {
 public:
  virtual ~Engine() = default;

  virtual const engine::SceneHeader& scene() const = 0;
  virtual void step() = 0;
  virtual std::int64_t steps() const = 0;  ///< done
  virtual double time_s() const = 0;
  virtual bool finished() const = 0;  ///< the scene's duration is reached
  virtual std::int64_t unconverged_steps() const = 0;

  virtual Snapshot snapshot() const = 0;
  /// From now on `look` is called after every step.
  virtual void observe(std::function<void(const engine::SolvedStep&)> look) = 0;

  /// From now on every `stride`-th step is written to the folder for ParaView, and every step to
  /// history.csv (mpm); finish_output() ends that.
  virtual void write_output(const std::filesystem::path& folder, std::int64_t stride) = 0;
  virtual void finish_output() = 0;

  /// From now on the problems of the selected steps are written for the folder; call it once.
  virtual void export_to(const std::filesystem::path& folder,
                         const engine::StepSelection& selection) = 0;
  /// Puts all of them in place; call it once, after the last step.
  virtual Exported finish_export() = 0;

  /// Keeps a picture of this moment; draws those kept as FOLDER/frame_000.svg and so on, in one
  /// common view.
  virtual void take_frame() = 0;
  virtual void draw_frames(const std::filesystem::path& folder) const = 0;

  /// What the run has come to, as one object, and the same in lines for people.
  virtual nlohmann::json summary() const = 0;
  virtual std::string summary_text() const = 0;

  /// Saves the run, and goes on from where one of the same scene was saved, bit for bit.
  virtual void save(const std::filesystem::path& path) const = 0;
  virtual void restart(const std::filesystem::path& path) = 0;
};

/// What the program knows of an engine.
struct EngineKind {
  std::string_view name;
  std::span<const engine::BuiltinScene> builtin;
  engine::SceneHeader (*read)(const engine::SceneText& scene);
  std::string (*print)(const engine::SceneText& scene);  ///< the full scene with every default
  std::unique_ptr<Engine> (*make)(const engine::SceneText& scene, const EngineOptions& options);
};

EngineKind dem_engine();
EngineKind mpm_engine();
std::span<const EngineKind> all_engines();

/// The engine that the scene names. Throws InputError.
const EngineKind& engine_of(const engine::SceneText& scene);

/// A built-in scene of any engine, or a file.
engine::SceneText find_scene(const std::string& name_or_path);

/// Throws InputError for a scene or a variant that cannot be run.
std::unique_ptr<Engine> make_engine(const engine::SceneText& scene, const EngineOptions& options);

/// The scene's choice of a solver, with the variant of the options if they name one.
engine::SolverChoice solver_choice(const engine::SceneHeader& scene, const EngineOptions& options);

/// "frame_000.svg".
std::string frame_name(std::size_t index);

}  // namespace conebench::harness
