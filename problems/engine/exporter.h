#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "problems/engine/provisional_folder.h"
#include "problems/engine/scene_file.h"
#include "problems/engine/step_sample.h"
#include "problems/engine/step_selection.h"
#include "problems/engine/write_queue.h"
#include "problems/problem_file.h"

namespace conebench::engine {

/// The metadata of the problem of step `step`, named "<scene>_<step, 6 digits>".
problems::Metadata step_metadata(const SceneHeader& scene, std::string engine, std::int64_t step,
                                 double step_size_s);

/// What exporting cost the thread of the engine.
struct ExportCost {
  double total_s = 0.0;    ///< in all, waiting and finish() included
  std::int64_t waits = 0;  ///< times that the queue to the writer was full
  double waited_s = 0.0;   ///< for room in it
};

/// Writes the problems of a running simulation as files DIR/<problem's name>.h5, each with
/// geometry, the engine's guess, its own solution with eta, and its sampling weight: how many steps
/// it stands for. Steps without a problem do not count.
///
/// The engine hands a problem over; another thread writes it. A file of a range (all, every:N,
/// N..M) is in place once it is written, its weight is the stride. The files of a sample lie in a
/// ProvisionalFolder until finish().
///
/// Errors: OutputError when the folder or a file cannot be written, at a later step or in finish();
/// then no file of a sample is left. InputError when another process exports a sample of the same
/// scene to the same folder.
class Exporter {
 public:
  /// Makes the folder. The scene's seed draws the samples.
  Exporter(std::filesystem::path folder, const StepSelection& selection, const SceneHeader& scene);
  ~Exporter();  ///< finishes if need be, without an error: those of the engine matter more

  /// Puts every file in place. Call it after the last step.
  void finish();

  /// The files in order of steps, once finished.
  const std::vector<std::filesystem::path>& files() const { return files_; }
  std::int64_t written() const { return static_cast<std::int64_t>(files_.size()); }
  /// Steps in range that had no problem.
  std::int64_t without_problem() const { return without_problem_; }
  ExportCost cost() const;

 protected:
  /// Asks for the geometry only of a step that it writes.
  void write_if_selected(const SolvedStep& step,
                         const std::function<problems::Geometry()>& geometry);

 private:
  using MakeGeometry = std::function<problems::Geometry()>;

  void select(const SolvedStep& step, const MakeGeometry& geometry);
  void sample(const SolvedStep& step, const MakeGeometry& geometry);
  std::int64_t hand_over(const SolvedStep& step, const MakeGeometry& geometry,
                         const std::filesystem::path& folder, double weight);
  void drop(std::int64_t step);
  void publish_sample();

  std::filesystem::path folder_;
  StepSelection selection_;
  std::string scene_;
  std::unique_ptr<StepSample> sample_;
  std::map<std::int64_t, std::int64_t> jobs_;     // of the steps in the sample, in the queue
  std::optional<ProvisionalFolder> provisional_;  // where there is a sample
  std::vector<std::filesystem::path> files_;
  std::int64_t without_problem_ = 0;
  double total_s_ = 0.0;
  bool finished_ = false;
  WriteQueue queue_;  // last: its thread ends before the folder goes
};

}  // namespace conebench::engine
