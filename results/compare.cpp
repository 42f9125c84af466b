#include "results/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "problems/error.h"
#include "results/noise.h"
#include "results/profiles.h"

namespace conebench::results {
namespace {

std::string key_of(const Record& r, int repetition) {
  const Settings& s = r.settings;
  return fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}", r.problem.content_sha256,
                     r.solver, r.donor, s.tol, s.time_limit_s, s.memory_limit_bytes, s.stop, s.mode,
                     s.threads, s.timing, repetition, r.sequence.id, r.sequence.index);
}

std::string name_of(const Record& r) {
  return fmt::format("{} on {}, repetition {}", contender(r), r.problem.name, r.repetition);
}

using Rows = std::map<std::string, const Record*>;

// Of several rows of one task, the one that started last counts.
Rows rows_of(std::span<const Record> records, std::size_t& superseded) {
  Rows rows;
  for (const Record& record : records) {
    const auto [found, is_new] = rows.try_emplace(key_of(record, record.repetition), &record);
    if (is_new) continue;
    ++superseded;
    if (record.started_at >= found->second->started_at) found->second = &record;
  }
  return rows;
}

std::vector<std::string> names_missing_in(const Rows& other, const Rows& rows) {
  std::vector<std::string> names;
  for (const auto& [key, record] : rows) {
    if (!other.contains(key)) names.push_back(name_of(*record));
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<RowPair> pairs_of(const Rows& base, const Rows& fresh) {
  std::vector<RowPair> pairs;
  for (const auto& [key, record] : base) {
    const auto found = fresh.find(key);
    if (found == fresh.end()) continue;
    const double tol = record->settings.tol;
    pairs.push_back({.base = record,
                     .fresh = found->second,
                     .base_s = time_to_tolerance(*record, tol),
                     .fresh_s = time_to_tolerance(*found->second, tol)});
  }
  return pairs;
}

std::size_t set_scenes(std::vector<RowPair>& pairs) {
  std::vector<std::string> names;
  for (const RowPair& pair : pairs) names.push_back(scene_of(pair.base->problem));
  const Scenes scenes = number_scenes(names);
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i].scene = scenes.of_row[i];
  return scenes.names.size();
}

// The A/A floor of the side that is noisier.
std::optional<double> noise_of(std::span<const Record> base, std::span<const Record> fresh) {
  std::optional<double> noise;
  for (const auto& records : {base, fresh}) {
    std::map<std::string, std::vector<double>> times_of_task;
    for (const Record& record : records) {
      const double time_s = time_to_tolerance(record, record.settings.tol);
      if (std::isfinite(time_s)) times_of_task[key_of(record, 0)].push_back(time_s);
    }
    std::vector<std::vector<double>> times_s;
    for (auto& [key, of_task] : times_of_task) {
      std::sort(of_task.begin(), of_task.end());
      times_s.push_back(std::move(of_task));
    }
    const auto floor = noise_floor(times_s);
    if (floor) noise = std::max(*floor, noise.value_or(1.0));
  }
  return noise;
}

}  // namespace

std::vector<std::string> quantity_names() {
  return {"sgm(time)",  "p50(time)",         "p99(time)", "max(time)", "gm(eta)",
          "iterations", "worst(iterations)", "solved",    "failures",  "missing"};
}

const Quantity& Comparison::quantity(const std::string& name) const {
  const auto found = std::find_if(quantities.begin(), quantities.end(),
                                  [&](const Quantity& q) { return q.name == name; });
  problems::require(found != quantities.end(), name, "is no quantity of a comparison");
  return *found;
}

bool Comparison::no_difference_measurable() const {
  const auto time = quantity("sgm(time)").value;
  return noise && time && *time <= *noise && *time >= 1.0 / *noise;
}

std::map<std::string, std::optional<double>> Comparison::gate_values() const {
  std::map<std::string, std::optional<double>> values;
  for (const Quantity& q : quantities) values[q.name] = q.value;
  if (no_difference_measurable()) values["sgm(time)"] = 1.0;
  return values;
}

Comparison compare(std::span<const Record> base, std::span<const Record> fresh) {
  Comparison result;
  const Rows base_rows = rows_of(base, result.superseded);
  const Rows fresh_rows = rows_of(fresh, result.superseded);
  result.only_base = names_missing_in(fresh_rows, base_rows);
  result.only_fresh = names_missing_in(base_rows, fresh_rows);
  std::vector<RowPair> pairs = pairs_of(base_rows, fresh_rows);
  problems::require(!pairs.empty(), "compare", "none of the ", base_rows.size(),
                    " rows of BASE is among the ", fresh_rows.size(),
                    " of NEW: same problems, solvers, settings and repetitions expected");
  result.pairs = pairs.size();
  result.scenes = set_scenes(pairs);
  for (const RowPair& pair : pairs) {
    const bool before = pair.base_solved(), after = pair.fresh_solved();
    if (before && !after) result.new_failures.push_back(name_of(*pair.fresh));
    if (!before && after) result.new_successes.push_back(name_of(*pair.fresh));
    if (pair.base->host.host_class() != pair.fresh->host.host_class()) result.other_host = true;
  }
  std::sort(result.new_failures.begin(), result.new_failures.end());
  std::sort(result.new_successes.begin(), result.new_successes.end());
  result.quantities = quantities_of(pairs, result.scenes);
  result.quantities.push_back(
      {.name = "missing", .value = static_cast<double>(result.only_base.size())});
  result.noise = noise_of(base, fresh);
  return result;
}

}  // namespace conebench::results
