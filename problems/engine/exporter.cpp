#include "problems/engine/exporter.h"

#include <fmt/format.h>

#include <chrono>
#include <utility>

#include "problems/engine/text_file.h"
#include "problems/residual.h"

namespace conebench::engine {
namespace {

using Clock = std::chrono::steady_clock;

// Adds the time of its life to a sum.
class Timed {
 public:
  explicit Timed(double& sum_s) : sum_s_(sum_s) {}
  Timed(const Timed&) = delete;
  Timed& operator=(const Timed&) = delete;
  ~Timed() { sum_s_ += std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  double& sum_s_;
  Clock::time_point start_ = Clock::now();
};

std::string problem_name(std::string_view scene, std::int64_t step) {
  return fmt::format("{}_{:06}", scene, step);
}

std::string file_name(std::string_view scene, std::int64_t step) {
  return problem_name(scene, step) + ".h5";
}

StepFacts facts_of(const SolvedStep& step) {
  return {step.step, step.problem->cone_count(), step.answer->iterations, step.answer->converged};
}

problems::Solution solution_of(const problems::Problem& standard, Eigen::VectorXd r) {
  problems::Solution solution{.r = {},
                              .u = standard.rate(r),
                              .v = standard.velocity(r),
                              .eta = problems::evaluate_eta(standard, r)};
  solution.r = std::move(r);
  return solution;
}

// Memory that a step's problem keeps while it waits, most of it shared with the engine for a step.
std::size_t bytes_of(const problems::Problem& problem) {
  constexpr std::size_t kEntry = sizeof(double) + sizeof(int);
  constexpr std::size_t kVectorsOfRows = 6, kVectorsOfDofs = 4, kGeometryOfCone = 16;
  const auto entries =
      static_cast<std::size_t>(2 * problem.M().nonZeros() + problem.H().nonZeros());  // M, its root
  const auto numbers = kVectorsOfRows * static_cast<std::size_t>(problem.rows()) +
                       kVectorsOfDofs * static_cast<std::size_t>(problem.dofs()) +
                       kGeometryOfCone * static_cast<std::size_t>(problem.cone_count());
  return kEntry * entries + sizeof(double) * numbers;
}

}  // namespace

problems::Metadata step_metadata(const SceneHeader& scene, std::string engine, std::int64_t step,
                                 double step_size_s) {
  problems::Metadata metadata;
  metadata.name = problem_name(scene.name, step);
  metadata.engine = std::move(engine);
  metadata.scene = scene.name;
  metadata.step = step;
  metadata.step_size_s = step_size_s;
  return metadata;
}

Exporter::Exporter(std::filesystem::path folder, const StepSelection& selection,
                   const SceneHeader& scene)
    : folder_(std::move(folder)),
      selection_(selection),
      scene_(scene.name),
      sample_(make_sample(selection, static_cast<std::uint64_t>(scene.seed))),
      queue_(WriteQueue::Limits{}) {
  make_folder(folder_);
  if (sample_) provisional_.emplace(folder_, scene_);
}

Exporter::~Exporter() {
  try {
    finish();
  } catch (...) {
  }
}

void Exporter::write_if_selected(const SolvedStep& step, const MakeGeometry& geometry) {
  const Timed timed(total_s_);
  queue_.check();
  if (selection_.contains(step.step)) select(step, geometry);
}

void Exporter::select(const SolvedStep& step, const MakeGeometry& geometry) {
  if (!step.problem) {
    ++without_problem_;
  } else if (sample_) {
    sample(step, geometry);
  } else {
    hand_over(step, geometry, folder_, static_cast<double>(selection_.stride));
    files_.push_back(folder_ / file_name(scene_, step.step));
  }
}

void Exporter::sample(const SolvedStep& step, const MakeGeometry& geometry) {
  const StepSample::Verdict verdict = sample_->offer(facts_of(step));
  if (!verdict.keep) return;
  constexpr double kNotYetKnown = 1.0;
  if (verdict.instead_of) drop(*verdict.instead_of);
  jobs_[step.step] = hand_over(step, geometry, provisional_->path(), kNotYetKnown);
}

void Exporter::drop(std::int64_t step) {
  const auto job = jobs_.extract(step);
  if (queue_.cancel(job.mapped())) return;
  queue_.push([this, name = file_name(scene_, step)] { provisional_->drop(name); }, 0);
}

// Problems share their matrices, so that little is copied here; what is computed of them, the
// writer computes.
std::int64_t Exporter::hand_over(const SolvedStep& step, const MakeGeometry& geometry,
                                 const std::filesystem::path& folder, double weight) {
  problems::Metadata metadata = step.problem->metadata();
  metadata.sampling_weight = weight;
  problems::ProblemFile file{
      step.problem->with_metadata(std::move(metadata)), geometry(), *step.guess, {}};
  return queue_.push(
      [path = folder / file_name(scene_, step.step), file = std::move(file),
       standard = *step.standard, r = step.answer->r]() mutable {
        file.solution = solution_of(standard, std::move(r));
        problems::write_problem_file(path, file);
      },
      bytes_of(*step.problem));
}

void Exporter::finish() {
  if (std::exchange(finished_, true)) return;
  const Timed timed(total_s_);
  queue_.drain();
  if (sample_) publish_sample();
}

void Exporter::publish_sample() {
  std::vector<ProvisionalFolder::Entry> entries;
  for (const SampledStep& step : sample_->steps()) {
    entries.push_back({file_name(scene_, step.step), step.weight});
  }
  provisional_->publish(entries);
  for (const auto& entry : entries) files_.push_back(folder_ / entry.name);
  provisional_.reset();
}

ExportCost Exporter::cost() const { return {total_s_, queue_.waits(), queue_.waited_s()}; }

}  // namespace conebench::engine
