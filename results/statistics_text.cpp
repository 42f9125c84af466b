#include "results/statistics_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "results/deadlines.h"
#include "results/rank_stability.h"
#include "results/shares.h"
#include "results/tails.h"

namespace conebench::results {
namespace {

// With more scenes than this, one of them decides little, and leaving each out takes long.
constexpr std::size_t kMostScenesLeftOut = 200;

std::string percent(const std::optional<Interval>& interval) {
  if (!interval) return "-";
  return fmt::format("{:.0f} to {:.0f} %", 100 * interval->low, 100 * interval->high);
}

TextTable tails_table(const GroupNumbers& n) {
  std::map<std::string, std::vector<Record>> records;
  for (const Record& record : n.group().methods) records[contender(record)].push_back(record);
  TextTable table({"solver", "solved", "share, 95 %", "p50", "p90", "p99", "p99.9", "max",
                   "mean eta", "worst eta", "not run"});
  for (const Rank& line : n.ranking()) {
    const std::size_t s = n.place(line.solver);
    std::vector<double> times_s;
    for (const auto& row : n.shown().rows) times_s.push_back(row.time_s[s]);
    const auto tail = tails(times_s);
    const ResidualMean eta = residual_mean(records[line.solver]);
    const auto time = [&](double Tails::*member) {
      return tail ? format_time((*tail).*member) : "-";
    };
    table.add({tick(line.solver), fmt::format("{}/{}", line.solved, line.problems),
               percent(n.share_interval(line.solver)), time(&Tails::p50), time(&Tails::p90),
               time(&Tails::p99), time(&Tails::p99_9), time(&Tails::max),
               format_eta(eta.mean.value_or(Record::kUnknown)),
               format_eta(eta.worst.value_or(Record::kUnknown)), fmt::format("{}", line.not_run)});
  }
  return table;
}

std::string names_not_told_apart(const GroupNumbers& n, const std::string& solver) {
  std::string names;
  for (const std::string& other : n.not_told_apart_from(solver)) {
    names += (names.empty() ? "" : ", ") + tick(other);
  }
  return names.empty() ? "-" : names;
}

// Of a solver against the best one.
std::vector<std::string> ratio_cells(const GroupNumbers& n, const std::string& solver) {
  const std::string& best = n.ranking().front().solver;
  if (solver == best) return {"1", "", ""};
  const SolverPair pair = n.pair(solver, best);
  const std::string over = fmt::format("{}", pair.both_solved);
  if (!pair.time_ratio) return {"-", "", over};
  const auto& interval = pair.time_interval;
  return {fmt::format("{:.3g}", *pair.time_ratio),
          interval ? fmt::format("{:.3g} to {:.3g}", interval->low, interval->high) : "-", over};
}

std::string noise_text(const GroupNumbers& n) {
  double largest = 0.0;
  for (const SolverPair& pair : n.pairs()) {
    if (pair.noise_is_measured) largest = std::max(largest, pair.noise);
  }
  if (largest == 0.0) {
    return fmt::format(
        "No task was repeated, so the noise of the clock is not known: ratios within {:.2f} are "
        "taken as noise.",
        kAssumedNoise);
  }
  return fmt::format(
      "A/A: the repetitions of two identical solvers would show ratios of up to {:.3f} (the "
      "largest of all pairs); no order is claimed inside it.",
      largest);
}

double share_at(const std::vector<Step>& steps, double value) {
  double share = 0.0;
  for (const Step& step : steps) {
    if (step.value <= value) share = std::max(share, step.share);
  }
  return share;
}

// Shares at `columns` values that grow tenfold from `first`.
TextTable time_table(const GroupNumbers& n, const std::vector<std::vector<Step>>& curves,
                     double first, int columns, const std::string& per) {
  std::vector<std::string> header = {"solver"};
  for (int k = 0; k < columns; ++k) header.push_back(format_time(first * std::pow(10.0, k)) + per);
  TextTable table(header);
  for (const Rank& line : n.ranking()) {
    std::vector<std::string> cells = {tick(line.solver)};
    for (int k = 0; k < columns; ++k) {
      const double share = share_at(curves[n.place(line.solver)], first * std::pow(10.0, k));
      cells.push_back(fmt::format("{:.0f} %", 100 * share));
    }
    table.add(std::move(cells));
  }
  return table;
}

std::string flips_text(const std::vector<Flip>& flips, const char* what) {
  if (flips.empty()) return fmt::format("No order of two solvers hangs on one {}. ", what);
  const Flip& first = flips.front();
  return fmt::format(
      "{} orders of two solvers turn round without one {}, e.g. {} and {} without {}. ",
      flips.size(), what, tick(first.first), tick(first.second), tick(first.left_out));
}

TextTable places_table(const Stability& stability) {
  TextTable table({"solver", "place", "without one scene", "without one solver"});
  const auto range = [](int best, int worst) {
    return best == worst ? fmt::format("{}", best) : fmt::format("{} to {}", best, worst);
  };
  for (const PlaceRange& p : stability.places) {
    table.add({tick(p.solver), fmt::format("{}", p.place), range(p.best_by_scene, p.worst_by_scene),
               range(p.best_by_solver, p.worst_by_solver)});
  }
  return table;
}

}  // namespace

Block tails_block(const GroupNumbers& n) {
  return {
      fmt::format("Tails at eta <= {:.0e}", n.tol()),
      {tails_table(n)},
      fmt::format(
          "Times that p % of the problems do not exceed: order statistics, in which a failure "
          "is infinite, so that a dash stands where a percentile falls among failures. *share, "
          "95 %*: interval of the share solved, bootstrap over {} scenes{}. *mean eta*: "
          "geometric, of the successes alone, floored at {:.0e}; *worst eta*: of all answers, "
          "failures included. Problems that some solver was not run on count for none.",
          n.scenes(), n.scenes() < kFewestScenes ? ": too few for an interval" : "", kEtaFloor)};
}

Block apart_block(const GroupNumbers& n) {
  if (n.ranking().size() < 2) return {};
  TextTable table({"solver", "time over the best's", "95 %", "over", "not told apart from"});
  for (const Rank& line : n.ranking()) {
    std::vector<std::string> cells = {tick(line.solver)};
    for (std::string& cell : ratio_cells(n, line.solver)) cells.push_back(std::move(cell));
    cells.push_back(names_not_told_apart(n, line.solver));
    table.add(std::move(cells));
  }
  return {"Which solvers are told apart",
          {std::move(table)},
          "Two solvers are told apart when the 95 % interval of the difference of their shares "
          "solved leaves out 0, or that of their time ratio (geometric mean over the problems that "
          "both solve, *over*) leaves out 1 and the ratio is outside the noise. Intervals resample "
          "scenes, since the steps of one are correlated, each pair by itself. " +
              noise_text(n)};
}

Block shares_block(const GroupNumbers& n) {
  const SolvedCounts counts = solved_counts(n.group().methods, n.tol());
  std::vector<std::string> header = {"solver"};
  for (const double tol : counts.tolerances) header.push_back(fmt::format("{:.0e}", tol));
  TextTable table(header);
  for (const Rank& line : n.ranking()) {
    std::vector<std::string> cells = {tick(line.solver)};
    for (const int solved : counts.solved[n.place(line.solver)]) {
      cells.push_back(fmt::format("{}", solved));
    }
    table.add(std::move(cells));
  }
  return {"Solved against tolerance",
          {std::move(table)},
          fmt::format("Of {} problems, within the time limit.", counts.problems)};
}

Block time_block(const GroupNumbers& n) {
  constexpr double kFirst_s = 1e-4, kFirstPerCone_s = 1e-6;
  constexpr int kColumns = 6;
  return {"Solved within a time",
          {time_table(n, time_distributions(n.table()), kFirst_s, kColumns, ""),
           time_table(n, data_profiles(n.table()), kFirstPerCone_s, kColumns, " a cone")},
          fmt::format("Share of the {} problems solved within a time, and within a time per cone "
                      "(the data profile of Moré and Wild, in seconds per cone). Unlike a "
                      "performance profile, neither depends on who is compared.",
                      n.shown().rows.size())};
}

Block deadline_block(const GroupNumbers& n) {
  const auto deadlines_s = usual_deadlines_s(n.group().settings.time_limit_s);
  if (deadlines_s.empty()) return {};
  std::vector<std::string> header = {"solver"};
  std::map<std::string, std::vector<std::string>> cells;
  for (const double deadline_s : deadlines_s) {
    const std::string time = format_time(deadline_s);
    header.insert(header.end(), {time + ": missed", "median eta", "p90 eta"});
    for (const DeadlineRow& row : deadline_rows(n.group().methods, deadline_s)) {
      auto& of_solver = cells[row.solver];
      of_solver.push_back(fmt::format("{:.0f} %", 100 * row.miss_rate()));
      of_solver.push_back(format_eta(row.median_eta));
      of_solver.push_back(format_eta(row.p90_eta));
    }
  }
  TextTable table(header);
  for (const Rank& line : n.ranking()) {
    std::vector<std::string> row = {tick(line.solver)};
    row.insert(row.end(), cells[line.solver].begin(), cells[line.solver].end());
    row.resize(header.size(), "-");
    table.add(std::move(row));
  }
  return {"Deadlines",
          {std::move(table)},
          fmt::format("*missed*: tasks whose answer at that time of the solver is above eta = "
                      "{:.0e}; *eta*: what the answer held then is worth (a dash: none yet).",
                      n.tol())};
}

Block stability_block(const GroupNumbers& n) {
  if (n.ranking().size() < 2) return {};
  if (n.scenes() > kMostScenesLeftOut) {
    return {"Rank stability",
            {},
            fmt::format("{} scenes: no single one decides; none was left out.", n.scenes())};
  }
  const Stability stability = rank_stability(n.table());
  return {"Rank stability",
          {places_table(stability)},
          flips_text(stability.scene_flips, "scene") +
              flips_text(stability.solver_flips, "other solver") +
              "Performance profiles are recomputed for those that are left: they depend on who is "
              "compared."};
}

}  // namespace conebench::results
