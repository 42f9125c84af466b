#include "harness/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

#include "harness/interrupt.h"
#include "harness/variants.h"
#include "problems/error.h"
#include "results/journal.h"
#include "results/report.h"
#include "results/verdict.h"

namespace conebench::harness {
namespace {

// Without marks of emphasis.
std::string plain(std::string text) {
  for (auto at = text.find("**"); at != text.npos; at = text.find("**")) text.erase(at, 2);
  return text;
}

}  // namespace

std::vector<solvers::Solver> make_all_solvers(const std::vector<std::string>& variants) {
  std::vector<solvers::Solver> all;
  for (const std::string& variant : variants) {
    for (solvers::Solver& solver : make_solvers(variant)) {
      const bool known =
          std::any_of(all.begin(), all.end(), [&](const auto& s) { return s.name == solver.name; });
      if (!known) all.push_back(std::move(solver));
    }
  }
  return all;
}

void tell(const FoundSources& found) {
  fmt::print(stderr, "{} problems", found.problems.size());
  if (found.twins > 0) fmt::print(stderr, ", {} files with equal content left out", found.twins);
  if (found.unwanted > 0) fmt::print(stderr, ", {} that --where leaves out", found.unwanted);
  if (found.skipped > 0) fmt::print(stderr, ", {} other files skipped", found.skipped);
  fmt::print(stderr, "\n");
  for (const std::string& why : found.unreadable) fmt::print(stderr, "left out: {}\n", why);
}

int tell(const CampaignSummary& summary) {
  fmt::print(stderr, "{} tasks: {} done now, {} kept from before\n", summary.tasks, summary.done,
             summary.earlier);
  for (const std::string& task : summary.lost) fmt::print(stderr, "could not run: {}\n", task);
  for (const std::string& sign : summary.drift) {
    fmt::print(stderr, "the machine changed while this ran: {}\n", sign);
  }
  if (summary.interrupted) {
    fmt::print(stderr, "interrupted; the same command goes on where this one stopped\n");
    return kInterruptedExit;
  }
  return summary.lost.empty() ? 0 : 3;
}

void print_rankings(std::span<const results::Record> records) {
  for (const results::Group& group : results::group_by_settings(records)) {
    if (group.methods.empty()) continue;
    fmt::print("{}\n", results::describe(group.settings));
    for (const double tol : group.tolerances()) {
      fmt::print("\nverified eta <= {:.0e}\n{}", tol, results::ranking_table(group.methods, tol));
      const std::string remark = results::ranking_remark(group.methods, tol);
      if (!remark.empty()) fmt::print("{}\n", remark);
    }
    fmt::print("\n{}\n\n", plain(results::verdict(results::GroupNumbers(group)).sentence));
  }
}

std::vector<results::Record> load_records(const std::filesystem::path& results_dir) {
  problems::require(std::filesystem::exists(results_dir), results_dir.string(), "no such folder");
  results::JournalContent content = results::read_results(results_dir);
  if (content.torn_lines > 0) {
    fmt::print(stderr, "{}: {} torn lines do not count\n", results_dir.string(),
               content.torn_lines);
  }
  problems::require(!content.records.empty(), results_dir.string(),
                    "holds no journal with a record, so no results");
  return std::move(content.records);
}

}  // namespace conebench::harness
