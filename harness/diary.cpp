#include "harness/diary.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <optional>

#include "harness/host.h"
#include "results/output.h"

namespace conebench::harness {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t kMostEarlier = 20;  // runs that are kept in mind

fs::path diary_path(const fs::path& results_dir, results::Shard shard) {
  if (shard.count == 1) return results_dir / "campaign.json";
  return results_dir / fmt::format("campaign-{}-of-{}.json", shard.index, shard.count);
}

json to_json(const Calibration& c) {
  json j = {{"arithmetic_s", c.arithmetic_s},
            {"memory_s", c.memory_s},
            {"arithmetic_spread", c.arithmetic_spread},
            {"memory_spread", c.memory_spread},
            {"processor_s", c.processor_s},
            {"stolen_s", c.stolen_s}};
  if (c.frequency_hz) j["frequency_hz"] = *c.frequency_hz;
  return j;
}

// Of a diary; nothing where that run did not get so far.
std::optional<Calibration> calibration_in(const json& diary, const char* key) {
  const auto found = diary.find(key);
  if (found == diary.end() || !found->is_object()) return std::nullopt;
  Calibration c{.arithmetic_s = found->value("arithmetic_s", 0.0),
                .memory_s = found->value("memory_s", 0.0),
                .arithmetic_spread = found->value("arithmetic_spread", 0.0),
                .memory_spread = found->value("memory_spread", 0.0)};
  if (!(c.arithmetic_s > 0.0) || !(c.memory_s > 0.0)) return std::nullopt;
  return c;  // the counts of processor time are of one boot of one machine
}

json read(const fs::path& path) {
  std::ifstream file(path);
  json diary = json::parse(file, nullptr, false);
  return diary.is_object() ? diary : json::object();
}

std::vector<fs::path> diaries_in(const fs::path& results_dir) {
  std::vector<fs::path> paths;
  if (!fs::is_directory(results_dir)) return paths;
  for (const auto& entry : fs::directory_iterator(results_dir)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with("campaign") && name.ends_with(".json")) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

// Runs before this one, the first one first; of each what it said, without its own list.
json earlier_runs(const fs::path& path) {
  json last = read(path);
  json runs = last.value("earlier", json::array());
  last.erase("earlier");
  if (!last.empty()) runs.push_back(std::move(last));
  if (runs.size() > kMostEarlier) {
    runs.erase(runs.begin(), runs.end() - static_cast<std::ptrdiff_t>(kMostEarlier));
  }
  return runs;
}

// One run of a campaign or shard.
struct MarkedRun {
  std::string name;  ///< "campaign-3-of-20, run 1"
  json diary;
};

std::vector<MarkedRun> runs_of(const fs::path& path) {
  json diary = read(path);
  json runs = diary.value("earlier", json::array());
  diary.erase("earlier");
  runs.push_back(std::move(diary));
  std::vector<MarkedRun> named;
  for (std::size_t k = 0; k < runs.size(); ++k) {
    std::string name = path.stem().string();
    if (runs.size() > 1) name += fmt::format(", run {}", k + 1);
    named.push_back({name, runs[k]});
  }
  return named;
}

void mark_run(const MarkedRun& run, std::vector<std::string>& marks) {
  if (!calibration_in(run.diary, "calibration_before")) return;
  if (!calibration_in(run.diary, "calibration_after")) {
    marks.push_back(run.name + ": it ended without its second calibration");
  }
  for (const json& sign : run.diary.value("drift", json::array())) {
    if (sign.is_string()) marks.push_back(run.name + ": " + sign.get<std::string>());
  }
}

// Against the median of all runs, part by part: a machine that is slow throughout does not drift.
void mark_odd_ones(const std::vector<MarkedRun>& runs, std::vector<std::string>& marks) {
  std::vector<Calibration> known;
  std::vector<std::string> names;
  for (const MarkedRun& run : runs) {
    if (const auto c = calibration_in(run.diary, "calibration_before")) {
      known.push_back(*c);
      names.push_back(run.name);
    }
  }
  if (known.size() < 2) return;
  const auto median = [&](double Calibration::*member) {
    std::vector<double> values;
    for (const Calibration& c : known) values.push_back(c.*member);
    std::sort(values.begin(), values.end());
    return values[(values.size() - 1) / 2];
  };
  const Calibration usual{.arithmetic_s = median(&Calibration::arithmetic_s),
                          .memory_s = median(&Calibration::memory_s),
                          .arithmetic_spread = median(&Calibration::arithmetic_spread),
                          .memory_spread = median(&Calibration::memory_spread)};
  for (std::size_t k = 0; k < known.size(); ++k) {
    for (const std::string& sign : signs_of_drift(usual, known[k])) {
      marks.push_back(names[k] + ", against the median of the runs: " + sign);
    }
  }
}

}  // namespace

Diary::Diary(const fs::path& results_dir, results::Shard shard, const std::string& command,
             int jobs)
    : path_(diary_path(results_dir, shard)),
      text_({{"command", command},
             {"jobs", jobs},
             {"started_at", utc_now()},
             {"host", results::to_json(current_host())},
             {"earlier", earlier_runs(path_)}}) {
  write();
}

void Diary::before() { before_ = measure("calibration_before"); }

std::vector<std::string> Diary::after() {
  const std::vector<std::string> signs = signs_of_drift(before_, measure("calibration_after"));
  text_["drift"] = signs;
  text_["ended_at"] = utc_now();
  write();
  return signs;
}

Calibration Diary::measure(const char* key) {
  const Calibration now = calibrate();
  text_[key] = to_json(now);
  write();
  return now;
}

void Diary::write() const {
  results::write_text_file(path_, text_.dump(2, ' ', false, json::error_handler_t::replace) + "\n");
}

std::string campaign_command(const fs::path& results_dir) {
  fs::path path = diary_path(results_dir, {});
  const auto paths = diaries_in(results_dir);
  if (!fs::exists(path) && !paths.empty()) path = paths.front();
  return read(path).value("command", std::string());
}

std::vector<std::string> machine_marks(const fs::path& results_dir) {
  std::vector<MarkedRun> runs;
  for (const fs::path& path : diaries_in(results_dir)) {
    for (MarkedRun& run : runs_of(path)) runs.push_back(std::move(run));
  }
  std::vector<std::string> marks;
  for (const MarkedRun& run : runs) mark_run(run, marks);
  mark_odd_ones(runs, marks);
  return marks;
}

void copy_diaries(const std::vector<fs::path>& from, const fs::path& to) {
  for (std::size_t k = 0; k < from.size(); ++k) {
    for (const fs::path& path : diaries_in(from[k])) {
      const std::string name = path.stem().string().substr(std::string("campaign").size());
      results::write_text_file(
          to / fmt::format("campaign-folder-{}{}.json", k + 1, name),
          read(path).dump(2, ' ', false, json::error_handler_t::replace) + "\n");
    }
  }
}

}  // namespace conebench::harness
