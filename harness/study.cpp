#include "harness/study.h"

#include <toml++/toml.h>

#include <algorithm>
#include <charconv>

#include "harness/summary.h"
#include "harness/units.h"
#include "harness/variants.h"
#include "problems/engine/toml_reader.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

using engine::Range;
using engine::TomlReader;
using problems::require;

constexpr std::size_t kMostThreadCounts = 64;

toml::table parse(const std::filesystem::path& path) {
  try {
    return toml::parse_file(path.string());
  } catch (const toml::parse_error& error) {
    throw problems::InputError(path.string(), "line " + std::to_string(error.source().begin.line) +
                                                  ": " + std::string(error.description()));
  }
}

void read_lists(TomlReader& reader, Study& study) {
  study.problems = reader.some_texts("problems");
  study.solvers = reader.some_texts("solvers");
  if (reader.has("tol")) study.tolerances = reader.some_numbers("tol", Range::kPositive);
  if (reader.has("mode")) study.modes = reader.some_texts("mode");
  if (reader.has("donors")) study.donors = reader.some_texts("donors");
  if (!reader.has("threads")) return;
  study.threads.clear();
  for (const std::int64_t n : reader.integers("threads", 1, kMostThreadCounts, 1)) {
    study.threads.push_back(static_cast<int>(n));
  }
}

void read_limits(TomlReader& reader, Study& study) {
  study.where = reader.text("where", study.where);
  study.time_limit = reader.text("time_limit", study.time_limit);
  study.hard_limit = reader.text("hard_limit", study.hard_limit);
  study.memory = reader.text("memory", study.memory);
  study.stop = reader.text("stop", study.stop);
  study.seed =
      static_cast<std::uint64_t>(reader.integer("seed", 0, static_cast<std::int64_t>(study.seed)));
}

std::string read_repetitions(const toml::table& table, TomlReader& reader) {
  if (table["repetitions"].is_string()) return reader.text("repetitions");
  return std::to_string(reader.integer("repetitions", 1, 1));
}

// A folder or file of a study lies where the study lies.
std::string beside(const std::filesystem::path& study, const std::string& problem) {
  const std::filesystem::path path = problem;
  return (path.is_absolute() ? path : study.parent_path() / path).string();
}

int count_from(const std::string& text) {
  int count = 0;
  const auto end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, count);
  require(error == std::errc() && stopped == end && count >= 1, "repetitions", "\"", text,
          "\"; expected a whole number >= 1, or auto");
  return count;
}

solvers::Stop stop_at(const Study& study, double tol) {
  require(study.stop == "common" || study.stop == "own", "stop", "\"", study.stop,
          "\"; known: common, own");
  solvers::Stop stop{
      .tol = tol,
      .time_limit_s = parse_duration_s(study.time_limit, "time_limit"),
      .test = study.stop == "own" ? solvers::StopTest::kOwn : solvers::StopTest::kCommon};
  stop.check();
  return stop;
}

// What is given twice would be run twice and count once.
template <class Value>
void require_distinct(const char* key, const std::vector<Value>& values) {
  for (auto value = values.begin(); value != values.end(); ++value) {
    require(std::find(values.begin(), value, *value) == value, key, *value,
            " stands twice, expected it once");
  }
}

}  // namespace

Study read_study(const std::filesystem::path& path) {
  require(std::filesystem::is_regular_file(path), path.string(), "is no file; expected a study");
  const toml::table table = parse(path);
  TomlReader reader(table, "", path.string());
  if (reader.integer("schema", 1) != 1) reader.fail("schema", "expected 1");
  Study study;
  read_lists(reader, study);
  read_limits(reader, study);
  study.repetitions = read_repetitions(table, reader);
  reader.finish();
  for (std::string& problem : study.problems) problem = beside(path, problem);
  return study;
}

Plan check(const Study& study) {
  Plan plan;
  require(!study.solvers.empty(), "-s, solvers",
          "none given, expected some, e.g. auto gs newton-ac");
  require_distinct("tol", study.tolerances);
  require_distinct("mode", study.modes);
  require_distinct("donors", study.donors);
  require_distinct("threads", study.threads);
  for (const double tol : study.tolerances) plan.stops.push_back(stop_at(study, tol));
  const auto solvers = make_all_solvers(study.solvers);
  plan.solvers.assign(solvers.begin(), solvers.end());
  for (const std::string& mode : study.modes) plan.modes.push_back(mode_from(mode, "mode"));
  const bool sequence =
      std::find(plan.modes.begin(), plan.modes.end(), Mode::kSequence) != plan.modes.end();
  require(sequence || study.donors == Study{}.donors, "donors",
          "given, but only mode `sequence` has donors");
  for (const std::string& donor : study.donors) {
    if (donor == kOwn) {
      plan.donors.emplace_back(std::nullopt);
    } else {
      plan.donors.emplace_back(make_solver(donor));
    }
  }
  for (const int threads : study.threads) {
    require(threads >= 1, "threads", threads, ", expected >= 1");
    plan.threads.push_back(threads);
  }
  if (!study.memory.empty()) plan.memory_limit_bytes = parse_bytes(study.memory, "memory");
  if (!study.hard_limit.empty())
    plan.hard_limit_s = parse_duration_s(study.hard_limit, "hard_limit");
  plan.repeat_for_confidence = study.repetitions == "auto";
  if (!plan.repeat_for_confidence) plan.repetitions = count_from(study.repetitions);
  plan.seed = study.seed;
  return plan;
}

}  // namespace conebench::harness
