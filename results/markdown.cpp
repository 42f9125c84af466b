#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/donors.h"
#include "results/model_gap.h"
#include "results/report.h"
#include "results/report_blocks.h"
#include "results/scaling.h"
#include "results/statistics_text.h"
#include "results/verdict.h"
#include "results/warm_gain.h"

namespace conebench::results {
namespace {

constexpr std::size_t kMostRows = 400;
constexpr int kSection = 2, kPart = 3;

std::string rankings(const Group& group, std::size_t index) {
  std::string text;
  for (const Block& block : ranking_blocks(group)) text += markdown(block, kPart);
  return text + fmt::format("![Performance profile at eta <= {:.0e}]({})\n\n{}\n\n",
                            group.settings.tol, profile_file(index), ranking_note());
}

std::string items(const std::vector<std::string>& sentences) {
  std::string text;
  for (const std::string& sentence : sentences) text += "- " + sentence + "\n";
  return text;
}

std::string verdict_text(const GroupNumbers& numbers) {
  const Verdict v = verdict(numbers);
  return v.sentence + "\n\n" + items(v.facts) + items(v.limits) + "\n";
}

std::string statistics(const GroupNumbers& n, std::span<const Group> groups,
                       const ReportInput& input) {
  const Group& group = n.group();
  std::string text = fmt::format("## How far to trust it: {}\n\n", describe(group.settings));
  for (const Block& block : {tails_block(n), apart_block(n), shares_block(n), time_block(n),
                             deadline_block(n), scaling(n).block, donor_block(group),
                             stability_block(n), step_block(n, input.scene_costs)}) {
    text += markdown(block, kPart);
  }
  if (const Group* cold = cold_twin(group, groups)) {
    text += markdown(warm_block(warm_gains(*cold, group), group.settings), kPart);
  }
  return text;
}

std::string cell(double time_s, const std::optional<Status>& status) {
  if (std::isfinite(time_s)) return format_time(time_s);
  if (!status) return "not run";
  return status == Status::kConverged ? "— late" : fmt::format("— {}", to_string(*status));
}

std::string time_rows(const TimeTable& times) {
  std::vector<std::string> header = {"problem", "cones"};
  for (const std::string& solver : times.solvers) header.push_back(tick(solver));
  TextTable table(header);
  const std::size_t shown = std::min(times.rows.size(), kMostRows);
  for (std::size_t i = 0; i < shown; ++i) {
    const TimeTable::Row& row = times.rows[i];
    std::vector<std::string> cells = {row.problem.name, fmt::format("{}", row.problem.cones)};
    for (std::size_t s = 0; s < row.time_s.size(); ++s) {
      cells.push_back(cell(row.time_s[s], row.status[s]));
    }
    table.add(std::move(cells));
  }
  std::string text =
      fmt::format("## Time to a verified eta <= {:.0e}\n\n{}\n", times.tol, table.text());
  if (shown < times.rows.size()) {
    text += fmt::format("{} more problems are in results.csv.\n\n", times.rows.size() - shown);
  }
  return text +
         "Solver time, set-up included, residuals excluded. A dash is a failure, with its "
         "status; *late* is an answer after the time limit.\n\n";
}

std::string group_sections(std::span<const Group> groups, std::size_t index,
                           const ReportInput& input) {
  const Group& group = groups[index];
  std::string text = fmt::format("## Ranking: {}\n\n", describe(group.settings));
  if (group.methods.empty()) {
    return text + markdown(model_block(group), kSection) + markdown(status_block(group), kSection);
  }
  const GroupNumbers numbers(group);
  return text + verdict_text(numbers) + rankings(group, index) +
         statistics(numbers, groups, input) + markdown(model_block(group), kSection) +
         markdown(status_block(group), kSection) + time_rows(numbers.table());
}

}  // namespace

std::string markdown_report(const ReportInput& input) {
  std::string text = fmt::format(
      "# conebench report\n\n{}\n\neta is the share of the initial violation of the contact law "
      "that is left [-].\n\n",
      summary_text(input.records));
  const auto groups = group_by_settings(input.records);
  for (std::size_t g = 0; g < groups.size(); ++g) text += group_sections(groups, g, input);
  return text + markdown(environment_block(input), kSection) + markdown(limits_block(), kSection);
}

}  // namespace conebench::results
