#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "results/profiles.h"
#include "results/record.h"
#include "results/shares.h"
#include "results/tails.h"

namespace conebench::results {

/// The results of a campaign as one SQLite file, derived from the journals: they are what counts,
/// the store is what is quick to ask. Columns are named like the members of a journal line, units
/// included; infinite is NULL.
///
///   problem    id, problem (its name), content_sha256, path, family, cones
///   solver     id, solver, kind, solver_build
///   settings   id, tol, time_limit_s, memory_limit_bytes, stop, mode, threads, timing
///   host       id, host (JSON)
///   status     id, status (its name)
///   task       id, task_key, problem_id, solver_id, settings_id, host_id, status_id, and every
///              other member: repetition, donor, eta, iterations, solve_s, ..., notes and sequence
///              as JSON. One row a record, in the order of the records.
///   curve      task_id, curve (JSON: [[time_s, iteration, eta], ...])
///   record     a view of all of the above, one column a member
///   contender  id, contender: see contender() and Builds::name()
///   outcome    settings_id, tol, contender_id, problem_id, time_s (NULL: not solved), status_id,
///              compared: what a task's repetitions come to (outcome_of) at each tolerance of
///              tolerance_ladder(); compared = 1 where every contender of the settings was run.
///              Models are left out, and so is what OneHost does not count.
///   solved     settings_id, tol, contender_id, solved, problems: counts of outcome where compared
///
/// Indexes: outcome by its key (settings_id, tol, contender_id, problem_id), solved by its key,
/// task by task_key (unique), by problem_id, and by (settings_id, solver_id, status_id). PRAGMA
/// application_id is kStoreId, PRAGMA user_version is kStoreVersion.
inline constexpr int kStoreId = 0x636f6e62;
inline constexpr int kStoreVersion = 3;

/// Replaces `path` in one step: a reader sees the old store or the new one. Throws InputError when
/// two records are of the same task, OutputError when it cannot be written.
void write_store(const std::filesystem::path& path, std::span<const Record> records);

/// A store, open for reading. Every function throws InputError when the file turns out damaged.
class Store {
 public:
  /// Throws InputError when the file is missing, truncated, no store, or of another version.
  explicit Store(const std::filesystem::path& path);
  ~Store();
  Store(Store&&) noexcept;

  /// In order of first appearance.
  std::vector<Settings> settings() const;

  /// The tolerances that the other questions may be asked at, falling.
  std::vector<double> tolerances(const Settings& settings) const;

  /// make_time_table() of the records with these settings (a Group's methods). InputError for a
  /// tolerance that is not among tolerances().
  TimeTable times(const Settings& settings, double tol) const;

  /// solved_counts() of them.
  SolvedCounts solved(const Settings& settings) const;

  /// The tails of each contender's times over the problems that all were run on.
  std::map<std::string, Tails> tails_of_times(const Settings& settings, double tol) const;

  /// How many tasks of each solver ended how; models included.
  std::map<std::string, std::map<Status, int>> statuses(const Settings& settings) const;

  /// All that was tried on one problem, in the order of the records.
  std::vector<Record> records_of_problem(const std::string& content_sha256) const;

  /// Everything, in the order in which it was given to write_store().
  std::vector<Record> records() const;

 private:
  struct Connection;
  std::unique_ptr<Connection> connection_;
};

}  // namespace conebench::results
