#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "harness/calibration.h"
#include "results/journal.h"

namespace conebench::harness {

/// What a campaign, or one shard of it, ran on, and how fast that was before and after:
/// RESULTS_DIR/campaign.json, or campaign-3-of-20.json. When it is resumed, the runs before stay in
/// its member "earlier", the last 20 of them.
class Diary {
 public:
  /// Writes what is known before anything ran. `command` is what the report shall say. Throws
  /// problems::OutputError, here and below.
  Diary(const std::filesystem::path& results_dir, results::Shard shard, const std::string& command,
        int jobs);

  void before();

  /// What changed since before().
  std::vector<std::string> after();

 private:
  Calibration measure(const char* key);
  void write() const;

  std::filesystem::path path_;
  nlohmann::json text_;
  Calibration before_;
};

/// The "command" of RESULTS_DIR/campaign.json, or of a shard's; empty if there is none.
std::string campaign_command(const std::filesystem::path& results_dir);

/// What the diaries of a results folder hold against its times, a line each: a machine that drifted
/// while a shard ran, or between its runs, a run that ended without its second calibration, a shard
/// whose machine was slower or faster than those of most.
std::vector<std::string> machine_marks(const std::filesystem::path& results_dir);

/// Copies the diaries of some results folders into another, each under a name of its own.
/// Throws problems::OutputError.
void copy_diaries(const std::vector<std::filesystem::path>& from, const std::filesystem::path& to);

}  // namespace conebench::harness
