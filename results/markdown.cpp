#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "results/report.h"
#include "results/text.h"

namespace conebench::results {
namespace {

constexpr std::size_t kMostRows = 400;

std::string tick(const std::string& text) { return "`" + text + "`"; }

std::string rankings(const Group& group, std::size_t index) {
  std::string text;
  for (const double tol : group.tolerances()) {
    text +=
        fmt::format("### Verified eta <= {:.0e}\n\n{}\n", tol, ranking_table(group.methods, tol));
  }
  text += fmt::format(
      "![Performance profile at eta <= {:.0e}]({})\n\n"
      "Ranked by the number of problems solved, then by *profile area*: the mean height of the "
      "performance profile (Dolan and Moré) over time ratios from 1 to {:.0f} on a log2 axis. "
      "*mean time* is the geometric mean, shifted by {}, over the problems that every solver with "
      "a success solves; *over* says how many those are. A failure is a failure: it is never given "
      "the time limit, nor averaged into a time.\n\n",
      group.settings.tol, profile_file(index), kLargestRatio, format_time(kMeanShift_s));
  return text;
}

std::string status_counts(std::span<const Record> records) {
  std::map<std::string, std::map<Status, int>> counts;
  std::set<Status> seen;
  for (const Record& r : records) {
    ++counts[r.solver][r.status];
    seen.insert(r.status);
  }
  std::vector<std::string> header = {"solver"};
  for (const Status status : seen) header.emplace_back(to_string(status));
  TextTable table(header);
  for (const auto& [solver, of_status] : counts) {
    std::vector<std::string> row = {tick(solver)};
    for (const Status status : seen) {
      const auto found = of_status.find(status);
      row.push_back(found == of_status.end() ? "" : fmt::format("{}", found->second));
    }
    table.add(std::move(row));
  }
  return "## How the tasks ended\n\n" + table.text() + "\n";
}

std::string cell(double time_s, const std::optional<Status>& status) {
  if (std::isfinite(time_s)) return format_time(time_s);
  if (!status) return "not run";
  return status == Status::kConverged ? "— late" : fmt::format("— {}", to_string(*status));
}

std::string time_rows(std::span<const Record> records, double tol) {
  const TimeTable times = make_time_table(records, tol);
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
  std::string text = fmt::format("## Time to a verified eta <= {:.0e}\n\n{}\n", tol, table.text());
  if (shown < times.rows.size()) {
    text += fmt::format("{} more problems are in results.csv.\n\n", times.rows.size() - shown);
  }
  return text +
         "Solver time, set-up included, residuals excluded. A dash is a failure, with its "
         "status; *late* is an answer after the time limit.\n\n";
}

std::string models(const Group& group) {
  TextTable table({"model", "tasks", "eta <= tol", "median eta", "largest eta"});
  std::map<std::string, std::vector<double>> etas;
  for (const Record& r : group.models) etas[r.solver].push_back(r.eta);
  for (auto& [solver, values] : etas) {
    std::sort(values.begin(), values.end());
    const auto within = std::upper_bound(values.begin(), values.end(), group.settings.tol);
    table.add({tick(solver), fmt::format("{}", values.size()),
               fmt::format("{}", within - values.begin()), format_eta(values[values.size() / 2]),
               format_eta(values.back())});
  }
  return "## Models\n\nThese solve an approximation of the problem. Their eta on the problem as "
         "posed is the model's gap, not a solver's failure, so they stay out of the profiles.\n\n" +
         table.text() + "\n";
}

std::string group_sections(const Group& group, std::size_t index) {
  std::string text = fmt::format("## Ranking: {}\n\n", describe(group.settings));
  if (!group.methods.empty()) text += rankings(group, index);
  if (!group.models.empty()) text += models(group);
  std::vector<Record> all = group.methods;
  all.insert(all.end(), group.models.begin(), group.models.end());
  text += status_counts(all);
  if (!group.methods.empty()) text += time_rows(group.methods, group.settings.tol);
  return text;
}

std::string environment(std::span<const Record> records, const std::string& command) {
  std::vector<Host> hosts;
  std::string first = records.front().started_at, last = first;
  for (const Record& r : records) {
    if (std::find(hosts.begin(), hosts.end(), r.host) == hosts.end()) hosts.push_back(r.host);
    first = std::min(first, r.started_at);
    last = std::max(last, r.started_at);
  }
  std::string text = "## Environment\n\n";
  for (const Host& h : hosts) {
    text += fmt::format("- {}, {} core{}; conebench {}, {}, {}\n", h.cpu, h.cores,
                        h.cores == 1 ? "" : "s", h.version, h.compiler, h.build);
  }
  text += fmt::format("- tasks started from {} to {}\n", first, last);
  if (!command.empty()) text += fmt::format("- command: `{}`\n", command);
  if (hosts.size() > 1) text += "- **Times from different machines do not compare.**\n";
  return text + "\n";
}

constexpr auto kLimits =
    "## Known limits\n\n"
    "- A residual is not an error bound: the problem is not convex, and a small eta does not say "
    "how far an answer is from a solution, nor from which one.\n"
    "- eta is recomputed from the returned reactions, outside the solvers. Where the attainable "
    "eta (results.csv) is near the tolerance, rounding alone can decide.\n"
    "- Times are of this machine and these sizes; differences below about 10 % are noise unless "
    "repetitions say otherwise.\n"
    "- A problem that nobody solves within the limits may have no solution.\n";

std::string summary(std::span<const Record> records) {
  std::set<std::string> problems, solvers;
  int refuted = 0, died = 0;
  for (const Record& r : records) {
    problems.insert(r.problem.content_sha256);
    solvers.insert(r.solver);
    refuted += r.status == Status::kRefuted;
    died += r.status == Status::kCrashed || r.status == Status::kKilledTime ||
            r.status == Status::kKilledMemory;
  }
  return fmt::format(
      "# conebench report\n\n{} problems, {} solvers, {} tasks, each in a process of its own. "
      "{} claims of success were refuted; {} workers died.\n\n"
      "eta is the share of the initial violation of the contact law that is left [-].\n\n",
      problems.size(), solvers.size(), records.size(), refuted, died);
}

}  // namespace

std::string markdown_report(std::span<const Record> records, const std::string& command) {
  std::string text = summary(records);
  const auto groups = group_by_settings(records);
  for (std::size_t g = 0; g < groups.size(); ++g) text += group_sections(groups[g], g);
  return text + environment(records, command) + kLimits;
}

}  // namespace conebench::results
