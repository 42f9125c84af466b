#include <fmt/format.h>

#include <memory>

#include "harness/commands/commands.h"
#include "harness/diary.h"
#include "harness/summary.h"
#include "problems/error.h"
#include "results/merge.h"
#include "results/store.h"

namespace conebench::harness {
namespace {

struct MergeOptions {
  std::vector<std::filesystem::path> results_dirs;
  std::filesystem::path output;
};

int merge(const MergeOptions& options) {
  const bool elsewhere = !options.output.empty();
  problems::require(elsewhere || options.results_dirs.size() == 1, "-o",
                    "needed to merge several results folders into one");
  results::Merger merger;
  for (const auto& folder : options.results_dirs) merger.add(load_records(folder));
  const auto folder = elsewhere ? options.output : options.results_dirs.front();
  if (elsewhere) {
    results::write_merged_journal(folder, merger.records());
    copy_diaries(options.results_dirs, folder);
  }
  const auto store = folder / "results.db";
  results::write_store(store, merger.records());
  fmt::print(stderr, "{} records, {} of tasks that another folder had done as well\n",
             merger.records().size(), merger.doubles());
  fmt::print("{}\n", store.string());
  return 0;
}

}  // namespace

void add_merge(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<MergeOptions>();
  CLI::App* verb = app.add_subcommand(
      "merge", "Join the journals of all shards, or of several results folders, in results.db");
  verb->add_option("RESULTS_DIR", options->results_dirs, "Results folders")
      ->type_name("")
      ->required();
  verb->add_option("-o,--output", options->output,
                   "Folder for the joined journal and results.db (default: the only RESULTS_DIR)")
      ->type_name("DIR");
  verb->callback([options, &exit_code] { exit_code = merge(*options); });
}

}  // namespace conebench::harness
