#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>

#include "harness/plan_file.h"
#include "harness/tasks.h"

namespace conebench::harness {

/// The options of the verbs that take a study: -p, -s, -c and one for each of its keys. What the
/// command line says replaces what the study file says.
class StudyOptions {
 public:
  void add_to(CLI::App& verb);

  /// A study file or -p was given, so that there is a study to look for problems with.
  bool given() const;

  /// Throws problems::InputError.
  Study study() const;

 private:
  CLI::App* verb_ = nullptr;
  std::filesystem::path file_;
  Study given_;
};

/// A study with its problems: those of the options, looked for and written to
/// RESULTS_DIR/plan.json, or else those that the folder's plan names. Nothing when interrupted.
/// Tells on stderr.
std::optional<PlanFile> find_plan(const StudyOptions& options,
                                  const std::filesystem::path& results_dir, int jobs);

/// What the plan comes to, and what its modes leave out, which is told on stderr.
TaskGroups groups_of(const PlanFile& plan);

}  // namespace conebench::harness
