#include "results/report_blocks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "results/one_host.h"

namespace conebench::results {
namespace {

TextTable ranking(std::span<const Record> records, double tol) {
  const auto lines = rank(make_time_table(records, tol));
  const bool some_not_run =
      std::any_of(lines.begin(), lines.end(), [](const Rank& r) { return r.not_run > 0; });
  std::vector<std::string> header = {"solver",       "solved",    "share", "fastest",
                                     "profile area", "mean time", "over"};
  if (some_not_run) header.push_back("not run");
  TextTable table(header);
  for (const Rank& r : lines) {
    std::vector<std::string> row = {
        tick(r.solver),
        fmt::format("{}/{}", r.solved, r.problems),
        fmt::format("{:.1f} %", 100.0 * r.solved / std::max(1, r.problems)),
        fmt::format("{}", r.fastest),
        fmt::format("{:.3f}", r.area),
        r.common_mean_s ? format_time(*r.common_mean_s) : "-",
        fmt::format("{}", r.common)};
    if (some_not_run) row.push_back(fmt::format("{}", r.not_run));
    table.add(std::move(row));
  }
  return table;
}

// The first of many.
std::vector<std::string> marks_shown(const std::vector<std::string>& marks) {
  constexpr std::size_t kMost = 12;
  std::vector<std::string> shown;
  for (std::size_t i = 0; i < std::min(marks.size(), kMost); ++i) {
    shown.push_back("**times in doubt:** " + marks[i]);
  }
  if (marks.size() > kMost) {
    shown.push_back(fmt::format("and {} more such marks, in campaign*.json", marks.size() - kMost));
  }
  return shown;
}

// Those that brought no problem to `tol`, best first as the others.
std::string without_success(std::span<const Rank> lines) {
  std::string names;
  for (const Rank& line : lines) {
    if (line.solved == 0 && line.problems > 0)
      names += (names.empty() ? "" : ", ") + tick(line.solver);
  }
  return names.empty() ? "" : "Solved nothing, so without a place: " + names + ". ";
}

// Contenders of which only the time of the whole run, to a tighter tolerance, is known.
std::string without_curve(std::span<const Record> records, double tol) {
  std::set<std::string> names;
  double own = tol;
  for (const Record& record : records) {
    if (!record.curve.empty() || !std::isfinite(time_to_tolerance(record, tol))) continue;
    names.insert(tick(contender(record)));
    own = std::min(own, record.settings.tol);
  }
  if (own >= tol || names.empty()) return {};
  return fmt::format("Of {} only the time to {:.0e} is known, which is an upper bound here. ",
                     fmt::join(names, ", "), own);
}

}  // namespace

std::string ranking_remark(std::span<const Record> records, double tol) {
  return without_success(rank(make_time_table(records, tol))) + without_curve(records, tol);
}

std::string ranking_table(std::span<const Record> records, double tol) {
  return ranking(records, tol).text();
}

std::string summary_text(std::span<const Record> records) {
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
      "{} problems, {} solvers, {} tasks, each in a process of its own. Claims of success "
      "refuted: {}; workers that died: {}.",
      problems.size(), solvers.size(), records.size(), refuted, died);
}

std::vector<Block> ranking_blocks(const Group& group) {
  std::vector<Block> blocks;
  if (group.methods.empty()) return blocks;
  for (const double tol : group.tolerances()) {
    blocks.push_back({fmt::format("Verified eta <= {:.0e}", tol),
                      {ranking(group.methods, tol)},
                      ranking_remark(group.methods, tol)});
  }
  return blocks;
}

std::string ranking_note() {
  return fmt::format(
      "Ranked by the number of problems solved, then by *profile area*: the mean height of the "
      "performance profile (Dolan and Moré) over time ratios from 1 to {:.0f} on a log2 axis. "
      "*mean time* is the geometric mean, shifted by {}, over the problems that every solver with "
      "a success solves; *over* says how many those are. A failure is a failure: it is never given "
      "the time limit, nor averaged into a time. What was not run is neither: problems that some "
      "solver was not run on are left out.",
      kLargestRatio, format_time(kMeanShift_s));
}

Block status_block(const Group& group) {
  std::map<std::string, std::map<Status, int>> counts;
  std::set<Status> seen;
  for (const auto* records : {&group.methods, &group.models}) {
    for (const Record& r : *records) {
      ++counts[r.solver][r.status];
      seen.insert(r.status);
    }
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
  return {"How the tasks ended", {std::move(table)}, {}};
}

Block environment_block(const ReportInput& input) {
  const auto& records = input.records;
  std::vector<Host> hosts;
  std::string first = records.front().started_at, last = first, text;
  for (const Record& r : records) {
    if (std::find(hosts.begin(), hosts.end(), r.host) == hosts.end()) hosts.push_back(r.host);
    first = std::min(first, r.started_at);
    last = std::max(last, r.started_at);
  }
  for (const Host& h : hosts) {
    text += fmt::format("- {}, {} core{}; conebench {}, {}, {}\n", h.cpu, h.cores,
                        h.cores == 1 ? "" : "s", h.version, h.compiler, h.build);
  }
  text += fmt::format("- tasks started from {} to {}", first, last);
  if (!input.command.empty()) text += fmt::format("\n- command: `{}`", input.command);
  if (hosts.size() > 1) text += "\n- **Times from different machines do not compare.**";
  if (const std::size_t left_out = OneHost(records).left_out(); left_out > 0) {
    text += fmt::format(
        "\n- {} rows are in no ranking: their problem was solved on another kind of machine, by "
        "more solvers or later",
        left_out);
  }
  for (const std::string& mark : marks_shown(input.machine_marks)) text += "\n- " + mark;
  return {"Environment", {}, text};
}

Block limits_block() {
  return {"Known limits",
          {},
          "- A residual is not an error bound: the problem is not convex, and a small eta does not "
          "say how far an answer is from a solution, nor from which one.\n"
          "- eta is recomputed from the returned reactions, outside the solvers. Where the "
          "attainable eta (results.csv) is near the tolerance, rounding alone can decide.\n"
          "- Times are of this machine and these sizes; differences below about 10 % are noise "
          "unless repetitions say otherwise (A/A).\n"
          "- A problem that nobody solves within the limits may have no solution."};
}

}  // namespace conebench::results
