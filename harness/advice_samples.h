#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "harness/advise.h"
#include "problems/engine/scene_file.h"

namespace conebench::harness {

/// Steps to choose on, and others to judge the choice on.
struct AdviceSamples {
  std::string scene;  ///< or the paths
  std::vector<Sample> training, validation;
  std::string source;       ///< one sentence: where both come from
  bool by_islands = false;  ///< as the engine solves them
  /// Cone problems that the engine solves in a step, on average; the samples are one of each step.
  double solves_per_step = 1.0;
  double fallback_limit_s = 10.0;
};

/// Runs the scene twice, with its seed and the next, and draws up to `count` steps of each at
/// random (reservoir), with the reactions that the engine would start from. A run ends with its
/// scene, or after `most_s` of wall clock. Where the seed changes nothing, every second window of
/// the one run's steps is for judging. Throws InputError where there is no step with contacts.
AdviceSamples sample_scene(const engine::SceneText& scene, std::int64_t count, double most_s);

/// Problems of files and folders, in the order of their scenes and steps; of each eight or so
/// windows in that order, every second is for judging. Throws InputError for fewer than two.
AdviceSamples sample_problems(const std::vector<std::filesystem::path>& paths);

}  // namespace conebench::harness
