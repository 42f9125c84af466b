#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "results/profiles.h"
#include "results/record.h"

namespace conebench::results {

/// Records of one kind of comparison: the same settings, methods and models apart.
struct Group {
  Settings settings;
  std::vector<Record> methods;  ///< and peers: they solve the problem as posed
  std::vector<Record> models;   ///< they solve an approximation of it

  /// 1e-4, 1e-6 and the run's own tolerance, those that the run could have met; loosest first.
  std::vector<double> tolerances() const;
};

/// In order of first appearance.
std::vector<Group> group_by_settings(std::span<const Record> records);

/// The ranking at one tolerance as a padded Markdown table; reads well in a terminal.
std::string ranking_table(std::span<const Record> records, double tol);

/// "stop = common, tol = 1e-08, time limit 500 ms".
std::string describe(const Settings& settings);

/// The whole report as Markdown. `command` is what made the results; empty if unknown.
std::string markdown_report(std::span<const Record> records, const std::string& command);

/// One row a task, RFC 4180; an infinite number is an empty cell.
std::string csv_report(std::span<const Record> records);

/// The name of the profile's image in a report: "profile.svg", then "profile-2.svg", ...
std::string profile_file(std::size_t group);

/// Writes report.md with its profile images ("md") and results.csv ("csv") into `folder`.
/// Errors: InputError without records or for an unknown format, OutputError when unwritable.
std::vector<std::filesystem::path> write_report(const std::filesystem::path& folder,
                                                std::span<const Record> records,
                                                const std::string& command,
                                                const std::set<std::string>& formats);

}  // namespace conebench::results
