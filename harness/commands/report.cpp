#include <fmt/format.h>

#include <memory>

#include "harness/commands/commands.h"
#include "harness/diary.h"
#include "harness/report_views.h"
#include "harness/step_costs.h"
#include "harness/summary.h"
#include "results/report.h"

namespace conebench::harness {
namespace {

struct ReportOptions {
  std::filesystem::path results_dir, output;
  std::vector<std::string> formats = results::report_formats();
};

// "-o FILE.html" names the page, "-o FOLDER" the folder; whatever else is written lies beside it.
results::ReportOutput place_of(const ReportOptions& options) {
  results::ReportOutput place{.folder = options.output,
                              .formats = {options.formats.begin(), options.formats.end()}};
  if (options.output.empty()) place.folder = options.results_dir;
  if (options.output.extension() == ".html") {
    place.folder = options.output.has_parent_path() ? options.output.parent_path() : ".";
    place.page = options.output.filename();
  }
  return place;
}

int report(const ReportOptions& options) {
  const auto records = load_records(options.results_dir);
  const auto place = place_of(options);
  results::ReportInput input{.records = records,
                             .command = campaign_command(options.results_dir),
                             .machine_marks = machine_marks(options.results_dir),
                             .scene_costs = read_scene_costs(options.results_dir),
                             .views = {},
                             .no_views = {}};
  if (place.formats.contains("html")) {
    ReportViews views = make_views(records);
    input.views = std::move(views.views);
    input.no_views = std::move(views.note);
  }
  for (const auto& file : results::write_report(input, place)) fmt::print("{}\n", file.string());
  return 0;
}

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* verb = app.add_subcommand(
      "report", "Turn results into a page to look at, tables and performance profiles");
  verb->add_option("RESULTS_DIR", options->results_dir, "The -o of `conebench run`")
      ->type_name("")
      ->required();
  verb->add_option("-o,--output", options->output,
                   "FILE.html, or a folder (default: RESULTS_DIR, and report.html in it)")
      ->type_name("FILE|DIR");
  verb->add_option("--format", options->formats,
                   "html (the page), md (report.md, profile.svg), csv (results.csv), tex "
                   "(report.tex, pgfplots), gbench (gbench.json for Google Benchmark's compare.py)")
      ->type_name("html|md|csv|tex|gbench")
      ->delimiter(',')
      ->capture_default_str();
  verb->callback([options, &exit_code] { exit_code = report(*options); });
}

}  // namespace conebench::harness
