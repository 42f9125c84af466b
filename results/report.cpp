#include "results/report.h"

#include <fmt/format.h>

#include <algorithm>

#include "problems/error.h"
#include "results/gbench.h"
#include "results/html.h"
#include "results/latex.h"
#include "results/output.h"
#include "results/speed_plots.h"
#include "results/svg_plot.h"

namespace conebench::results {
namespace {

void check(const ReportInput& input, const ReportOutput& output) {
  problems::require(!input.records.empty(), output.folder.string(), "no results yet");
  const auto known = report_formats();
  for (const std::string& format : output.formats) {
    problems::require(format != "html" || page_files().has_value(), "--format",
                      "html: this build has no page (CONEBENCH_REPORT_PAGE was OFF)");
    problems::require(std::find(known.begin(), known.end(), format) != known.end(), "--format",
                      "\"", format,
                      "\" is no format; known: ", fmt::format("{}", fmt::join(known, ", ")));
  }
}

}  // namespace

std::vector<std::string> report_formats() {
  std::vector<std::string> formats = {"md", "csv", "tex", "gbench"};
  if (page_files()) formats.insert(formats.begin(), "html");
  return formats;
}

std::string profile_file(std::size_t group) {
  return group == 0 ? "profile.svg" : fmt::format("profile-{}.svg", group + 1);
}

std::vector<std::filesystem::path> write_report(const ReportInput& input,
                                                const ReportOutput& output) {
  check(input, output);
  std::vector<std::filesystem::path> written;
  const auto write = [&](const std::string& name, const std::string& text) {
    write_text_file(output.folder / name, text);
    written.push_back(output.folder / name);
  };
  if (output.formats.contains("html")) write(output.page, html_report(input, *page_files()));
  if (output.formats.contains("md")) {
    const auto groups = group_by_settings(input.records);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      if (groups[g].methods.empty()) continue;
      const TimeTable table = make_time_table(groups[g].methods, groups[g].settings.tol);
      write(profile_file(g), svg(profile_plot(table, rank(table)), SvgUse::kFile));
    }
    write("report.md", markdown_report(input));
  }
  if (output.formats.contains("csv")) write("results.csv", csv_report(input.records));
  if (output.formats.contains("tex")) write("report.tex", latex_report(input));
  if (output.formats.contains("gbench")) write("gbench.json", gbench_report(input.records));
  return written;
}

}  // namespace conebench::results
