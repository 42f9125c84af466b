#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "harness/observables.h"

namespace conebench::harness {

/// What is asked of an ensemble of runs of one scene: every solver at every tolerance, with every
/// seed, beside a reference solver to a tight tolerance with the same seeds.
struct TrajectoryWish {
  std::string scene;
  std::vector<std::string> overrides{};
  std::vector<std::string> solvers{};  ///< variants; empty: the scene's
  std::vector<double> tolerances{};
  std::string seeds = "5";  ///< so many, from the scene's seed on; or a list: "1,4,9"
  std::string reference = "auto";
  double reference_tol = 1e-8;
  double reference_time_limit_s = 10.0;  ///< of a step; the scene's limit on iterations is lifted
  std::int64_t steps = 0;                ///< 0: the scene's duration
};

/// One run.
struct TrajectoryTask {
  engine::SceneText scene;  ///< with its seed, tolerance and limits
  std::string solver;
  double tol = 0.0;
  std::int64_t seed = 0;
  bool reference = false;
  std::int64_t steps = 0;
  std::string key;  ///< hash of all that the run depends on, this build of the program included
};

struct TrajectoryPlan {
  std::string scene, engine;
  std::vector<std::string> solvers;  ///< each once, in the order given
  std::vector<double> tolerances;    ///< each once, loosest first
  std::vector<std::int64_t> seeds;
  /// False when the seed changes nothing in this scene: then only the first seed is run.
  bool seed_matters = true;
  std::string reference;
  double reference_tol = 0.0;
  std::vector<TrajectoryTask> tasks;  ///< seed by seed, the reference first
};

/// Throws InputError: an unknown solver or scene, a bad list of seeds, a tolerance that is not
/// looser than the reference's, a scene that cannot be run. Cost: the scene is set up once a seed.
TrajectoryPlan plan_trajectories(const TrajectoryWish& wish);

/// A run that was done.
struct TrajectoryRow {
  std::string key, solver;
  double tol = 0.0;
  std::int64_t seed = 0;
  bool reference = false;
  Observed observed{};  ///< NaN throughout when it failed
  std::int64_t steps = 0;
  double wall_s = 0.0;
  std::string error{};  ///< why it failed: the solver returned numbers that are not finite
  std::string started_at{};
};

/// Runs a task to its end; `tick` is called after every step. Nothing when interrupted.
/// Throws InputError when the solver cannot take the scene's problems.
std::optional<TrajectoryRow> run_trajectory(const TrajectoryTask& task,
                                            const std::function<void()>& tick);

/// The rows of a plan, in the order of its tasks.
struct TrajectoryRows {
  std::vector<TrajectoryRow> rows;
  std::size_t earlier = 0;  ///< of them were in the folder already
  bool interrupted = false;
};

/// Runs what the folder's runs.jsonl does not hold yet, and appends it there, a line a run; without
/// a folder (empty path) nothing is kept. Progress on stderr. A line that was cut short does not
/// count. Throws InputError (a line that is no row), OutputError.
TrajectoryRows run_trajectories(const TrajectoryPlan& plan, const std::filesystem::path& folder);

}  // namespace conebench::harness
