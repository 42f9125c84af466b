#include <fmt/format.h>

#include <memory>

#include "harness/commands/commands.h"
#include "harness/summary.h"
#include "results/report.h"

namespace conebench::harness {
namespace {

struct ReportOptions {
  std::filesystem::path results_dir, folder;
  std::vector<std::string> formats = {"md", "csv"};
};

int report(const ReportOptions& options) {
  const auto records = load_records(options.results_dir);
  const auto folder = options.folder.empty() ? options.results_dir : options.folder;
  const auto written = results::write_report(folder, records, campaign_command(options.results_dir),
                                             {options.formats.begin(), options.formats.end()});
  for (const auto& file : written) fmt::print("{}\n", file.string());
  return 0;
}

}  // namespace

void add_report(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ReportOptions>();
  CLI::App* verb =
      app.add_subcommand("report", "Turn results into rankings, tables and performance profiles");
  verb->add_option("RESULTS_DIR", options->results_dir, "The -o of `conebench run`")->required();
  verb->add_option("-o,--output", options->folder, "Folder to write to (default: RESULTS_DIR)");
  verb->add_option("--format", options->formats, "md (report.md, profile.svg), csv (results.csv)")
      ->delimiter(',')
      ->capture_default_str();
  verb->callback([options, &exit_code] { exit_code = report(*options); });
}

}  // namespace conebench::harness
