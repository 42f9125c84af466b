#include "results/report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "problems/error.h"
#include "results/output.h"
#include "results/svg_profile.h"
#include "results/text.h"

namespace conebench::results {

std::vector<double> Group::tolerances() const {
  std::vector<double> tols;
  for (const double t : {1e-4, 1e-6}) {
    if (t > settings.tol) tols.push_back(t);
  }
  tols.push_back(settings.tol);
  return tols;
}

std::vector<Group> group_by_settings(std::span<const Record> records) {
  std::vector<Group> groups;
  for (const Record& record : records) {
    auto group = std::find_if(groups.begin(), groups.end(),
                              [&](const Group& g) { return g.settings == record.settings; });
    if (group == groups.end()) {
      groups.push_back({.settings = record.settings, .methods = {}, .models = {}});
      group = groups.end() - 1;
    }
    (record.kind == "model" ? group->models : group->methods).push_back(record);
  }
  return groups;
}

std::string ranking_table(std::span<const Record> records, double tol) {
  TextTable table({"solver", "solved", "share", "fastest", "profile area", "mean time", "over"});
  for (const Rank& r : rank(make_time_table(records, tol))) {
    table.add({"`" + r.solver + "`", fmt::format("{}/{}", r.solved, r.problems),
               fmt::format("{:.1f} %", 100.0 * r.solved / std::max(1, r.problems)),
               fmt::format("{}", r.fastest), fmt::format("{:.3f}", r.area),
               r.common_mean_s ? format_time(*r.common_mean_s) : "-", fmt::format("{}", r.common)});
  }
  return table.text();
}

std::string describe(const Settings& settings) {
  std::string text = fmt::format("stop = {}, tol = {:.0e}", settings.stop, settings.tol);
  if (std::isfinite(settings.time_limit_s)) {
    text += fmt::format(", time limit {}", format_time(settings.time_limit_s));
  }
  if (settings.memory_limit_bytes > 0) {
    text += fmt::format(", memory limit {} MiB", settings.memory_limit_bytes >> 20);
  }
  return text;
}

std::string profile_file(std::size_t group) {
  return group == 0 ? "profile.svg" : fmt::format("profile-{}.svg", group + 1);
}

std::vector<std::filesystem::path> write_report(const std::filesystem::path& folder,
                                                std::span<const Record> records,
                                                const std::string& command,
                                                const std::set<std::string>& formats) {
  problems::require(!records.empty(), folder.string(), "no results yet");
  std::vector<std::filesystem::path> written;
  const auto write = [&](const std::string& name, const std::string& text) {
    write_text_file(folder / name, text);
    written.push_back(folder / name);
  };
  for (const std::string& format : formats) {
    problems::require(format == "md" || format == "csv", "--format", "\"", format,
                      "\" is no format; known: md, csv");
  }
  if (formats.contains("md")) {
    const auto groups = group_by_settings(records);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (groups[g].methods.empty()) continue;
      const TimeTable table = make_time_table(groups[g].methods, groups[g].settings.tol);
      write(profile_file(g),
            profile_svg(table, rank(table),
                        fmt::format("Time to a verified eta <= {:.0e}, {} problems", table.tol,
                                    table.rows.size())));
    }
    write("report.md", markdown_report(records, command));
  }
  if (formats.contains("csv")) write("results.csv", csv_report(records));
  return written;
}

}  // namespace conebench::results
