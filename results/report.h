#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "results/group.h"
#include "results/problem_view.h"
#include "results/step_share.h"

namespace conebench::results {

/// What a report is made of.
struct ReportInput {
  std::span<const Record> records;
  std::string command{};                     ///< that made the results; empty if unknown
  std::vector<std::string> machine_marks{};  ///< what speaks against the times, a line each
  std::vector<SceneCost> scene_costs{};      ///< of the scenes whose engine was run
  std::vector<ProblemView> views{};          ///< hardest first
  std::string no_views{};                    ///< why there are none, or not more
};

/// Where it goes.
struct ReportOutput {
  std::filesystem::path folder;
  std::string page = "report.html";
  std::set<std::string> formats;  ///< of report_formats()
};

/// "html" (the page), "md" (report.md and its profile images), "csv" (results.csv), "tex"
/// (report.tex for pgfplots), "gbench" (gbench.json): those that this build has.
std::vector<std::string> report_formats();

/// The ranking at one tolerance as a padded Markdown table; reads well in a terminal.
std::string ranking_table(std::span<const Record> records, double tol);

/// What its reader must know besides: who solved nothing, and whose times are too long there. May
/// be empty.
std::string ranking_remark(std::span<const Record> records, double tol);

/// The whole report as Markdown.
std::string markdown_report(const ReportInput& input);

/// One row a task, RFC 4180; an infinite number is an empty cell.
std::string csv_report(std::span<const Record> records);

/// The name of the profile's image in a report: "profile.svg", then "profile-2.svg", ...
std::string profile_file(std::size_t group);

/// Writes the wanted formats. Returns the files.
/// Errors: InputError without records or for an unknown format, OutputError when unwritable.
std::vector<std::filesystem::path> write_report(const ReportInput& input,
                                                const ReportOutput& output);

}  // namespace conebench::results
