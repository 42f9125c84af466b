#include "harness/advice_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <set>

#include "harness/engine.h"
#include "harness/interrupt.h"
#include "problems/error.h"
#include "problems/load.h"
#include "problems/private_folder.h"

namespace conebench::harness {
namespace {

constexpr std::size_t kWindows = 8;

struct LoadedStep {
  Sample sample;
  std::string hash;
};

LoadedStep load(const std::filesystem::path& path) {
  problems::ProblemFile file = problems::load_problem(path);
  LoadedStep step{{file.problem.shifted(), std::move(file.guess)},
                  problems::content_sha256(file.problem)};
  if (step.sample.guess.size() == 0) {
    step.sample.guess = Eigen::VectorXd::Zero(step.sample.standard.rows());
  }
  return step;
}

struct SampledRun {
  std::vector<LoadedStep> steps;
  double solves_per_step = 1.0;
};

SampledRun run_and_sample(const engine::SceneText& scene, std::int64_t count, double most_s) {
  const problems::PrivateFolder folder;
  const std::unique_ptr<Engine> engine = make_engine(scene, {});
  engine->export_to(folder.path(), engine::parse_selection(fmt::format("reservoir:{}", count)));
  const auto start = std::chrono::steady_clock::now();
  const std::chrono::duration<double> limit(most_s);
  while (!engine->finished() && !interrupted()) {
    engine->step();
    if (std::chrono::steady_clock::now() - start > limit) break;
  }
  SampledRun run;
  for (const std::filesystem::path& file : engine->finish_export().files) {
    run.steps.push_back(load(file));
  }
  const std::int64_t steps = std::max<std::int64_t>(1, engine->steps());
  const std::int64_t solves = engine->summary().value("solves", steps);
  run.solves_per_step = std::max(1.0, static_cast<double>(solves) / static_cast<double>(steps));
  return run;
}

// Every second window of consecutive steps is for judging.
void split_by_windows(std::vector<LoadedStep> steps, AdviceSamples& samples) {
  const std::size_t length = std::max<std::size_t>(1, steps.size() / kWindows);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    auto& side = k / length % 2 == 0 ? samples.training : samples.validation;
    side.push_back(std::move(steps[k].sample));
  }
}

// What tells two runs apart: the hash of the first problem with a cone.
std::string first_problem(const engine::SceneText& scene, double most_s) {
  const problems::PrivateFolder folder;
  const std::unique_ptr<Engine> engine = make_engine(scene, {});
  engine->export_to(folder.path(), engine::parse_selection("all"));
  const auto start = std::chrono::steady_clock::now();
  const std::chrono::duration<double> limit(most_s);
  while (!engine->finished() && !interrupted() && engine->summary().at("cones_last") == 0) {
    engine->step();
    if (std::chrono::steady_clock::now() - start > limit) break;
  }
  const auto files = engine->finish_export().files;
  return files.empty() ? "" : load(files.front()).hash;
}

std::string why_one_run(std::string_view engine, bool seed_counts) {
  if (seed_counts) return "that of the next seed has too few steps with contacts";
  const std::string why = "the seed changes nothing";
  return engine == "mpm" ? why + " (it does with --set blocks[0].jitter=0.5)" : why;
}

}  // namespace

AdviceSamples sample_scene(const engine::SceneText& scene, std::int64_t count, double most_s) {
  const EngineKind& kind = engine_of(scene);
  const engine::SceneHeader header = kind.read(scene);
  AdviceSamples samples;
  samples.scene = header.name;
  samples.by_islands = kind.name == "dem";
  samples.fallback_limit_s = header.solver.time_limit_s;
  SampledRun run = run_and_sample(scene, count, most_s);
  samples.solves_per_step = run.solves_per_step;
  std::vector<LoadedStep>& first = run.steps;
  problems::require(!first.empty(), scene.subject, "no step had a contact, expected some");

  const std::vector<std::string> next = {fmt::format("seed={}", header.seed + 1)};
  const engine::SceneText other = engine::with_overrides(scene, next);
  const bool seed_counts = first_problem(scene, most_s) != first_problem(other, most_s);
  if (seed_counts) {
    for (LoadedStep& step : run_and_sample(other, count, most_s).steps) {
      samples.validation.push_back(std::move(step.sample));
    }
  }
  if (2 * samples.validation.size() >= first.size()) {
    for (LoadedStep& step : first) samples.training.push_back(std::move(step.sample));
    samples.source =
        fmt::format("seed {} to choose, seed {} to judge", header.seed, header.seed + 1);
    return samples;
  }
  problems::require(first.size() >= 2, scene.subject, "one step had contacts, expected two");
  samples.validation.clear();
  split_by_windows(std::move(first), samples);
  samples.source =
      "windows of one run in turn to choose and to judge: " + why_one_run(kind.name, seed_counts);
  return samples;
}

AdviceSamples sample_problems(const std::vector<std::filesystem::path>& paths) {
  AdviceSamples samples;
  std::vector<LoadedStep> steps;
  std::set<std::string> seen;
  for (const std::filesystem::path& file : problems::find_problems(paths).files) {
    LoadedStep step = load(file);
    if (seen.insert(step.hash).second) steps.push_back(std::move(step));
  }
  problems::require(steps.size() >= 2, paths.front().string(), "holds ", steps.size(),
                    " problems, expected at least two: some to choose on, some to judge on");
  const auto place = [](const LoadedStep& step) {
    const problems::Metadata& metadata = step.sample.standard.metadata();
    return std::pair(metadata.scene, metadata.step);
  };
  std::ranges::stable_sort(steps, {}, place);
  samples.scene = paths.front().string();
  samples.by_islands = std::ranges::all_of(steps, [](const LoadedStep& step) {
    return step.sample.standard.metadata().engine == "dem";
  });
  samples.source = "windows of the steps in turn to choose and to judge";
  split_by_windows(std::move(steps), samples);
  return samples;
}

}  // namespace conebench::harness
