#include "results/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "results/text.h"

namespace conebench::results {
namespace {

constexpr std::size_t kMostNamed = 3;
constexpr double kDependable = 0.95;

std::string plural(std::size_t count, const std::string& thing) {
  return fmt::format("{} {}{}", count, thing, count == 1 ? "" : "s");
}

std::string named(const std::vector<std::string>& solvers) {
  std::string text;
  const std::size_t shown = solvers.size() > kMostNamed + 1 ? kMostNamed : solvers.size();
  for (std::size_t i = 0; i < shown; ++i) {
    const bool last = i + 1 == solvers.size();
    text += (i == 0 ? "" : last ? " or " : ", ") + tick(solvers[i]);
  }
  return shown == solvers.size() ? text
                                 : fmt::format("{} or {} more", text, solvers.size() - shown);
}

double share_of(const Rank& line) {
  return static_cast<double>(line.solved) / std::max(1, line.problems);
}

std::string goal(const GroupNumbers& n) {
  const Settings& s = n.group().settings;
  std::string text = fmt::format("a verified eta <= {:.0e}", s.tol);
  if (std::isfinite(s.time_limit_s)) text += " within " + format_time(s.time_limit_s);
  return text;
}

std::string done(const Rank& line) {
  return fmt::format("{} of {} problems ({:.0f} %)", line.solved, line.problems,
                     100 * share_of(line));
}

std::string sentence(const GroupNumbers& n) {
  if (n.shown().rows.empty()) {
    return "**No comparison:** there is no problem that every solver was run on.";
  }
  const Rank& best = n.ranking().front();
  if (best.solved == 0) {
    return fmt::format("**Nothing here works:** no solver brought any of {} to {}.",
                       plural(n.shown().rows.size(), "problem"), goal(n));
  }
  if (n.ranking().size() == 1) {
    return fmt::format("{} brought {} to {}. **Nothing else was run**, so this compares nothing.",
                       tick(best.solver), done(best), goal(n));
  }
  const auto rivals = n.not_beaten_by_best();
  if (rivals.empty()) {
    return fmt::format(
        "**Use {}:** it brought {} to {}, and chance does not explain its lead over "
        "any of the {} others.",
        tick(best.solver), done(best), goal(n), n.ranking().size() - 1);
  }
  return fmt::format(
      "**{} leads, not beyond doubt:** it brought {} to {}, but these problems do "
      "not show it to be better than {}.",
      tick(best.solver), done(best), goal(n), named(rivals));
}

// How many problems any solver solves, and how many just one does.
std::string best_of_all(const GroupNumbers& n) {
  int any = 0, one = 0;
  for (const auto& row : n.shown().rows) {
    const auto solving = std::count_if(row.time_s.begin(), row.time_s.end(),
                                       [](double time_s) { return std::isfinite(time_s); });
    any += solving > 0;
    one += solving == 1;
  }
  const int all = static_cast<int>(n.shown().rows.size());
  return fmt::format(
      "Choosing the right solver for each problem would solve {} of {}; {} of them "
      "one solver alone can solve, and {} nobody does.",
      any, all, one, all - any);
}

std::string quickest(const GroupNumbers& n) {
  const Rank* best = nullptr;
  for (const Rank& line : n.ranking()) {
    if (!line.common_mean_s || line.common == 0) continue;
    if (!best || *line.common_mean_s < *best->common_mean_s) best = &line;
  }
  if (!best)
    return "No problem is solved by all solvers that solve any, so mean times do not compare.";
  return fmt::format(
      "On the {} that all of them solve, the easy ones, {} is the quickest: {} on "
      "average.",
      plural(static_cast<std::size_t>(best->common), "problem"), tick(best->solver),
      format_time(*best->common_mean_s));
}

std::string dependable(const GroupNumbers& n) {
  const Rank& best = n.ranking().front();
  if (share_of(best) >= kDependable) return {};
  return fmt::format("None is dependable here: even the leader fails on {} of {} problems.",
                     best.problems - best.solved, best.problems);
}

std::string scope(const GroupNumbers& n) {
  const auto interval = n.share_interval(n.ranking().front().solver);
  std::string text = fmt::format("It holds for {} of {}", plural(n.shown().rows.size(), "problem"),
                                 plural(n.scenes(), "scene"));
  if (!interval) return text + ", too few scenes to say how it carries over to others.";
  return text + fmt::format(
                    "; on other scenes like these the leader's share would lie between "
                    "{:.0f} and {:.0f} % (95 % interval).",
                    100 * interval->low, 100 * interval->high);
}

}  // namespace

Verdict verdict(const GroupNumbers& n) {
  Verdict result{.sentence = sentence(n), .facts = {}, .limits = {}};
  if (n.shown().rows.empty()) return result;
  const bool any_solved = n.ranking().front().solved > 0;
  if (any_solved) {
    result.facts.push_back(best_of_all(n));
    if (n.ranking().size() > 1) result.facts.push_back(quickest(n));
    if (const std::string text = dependable(n); !text.empty()) result.facts.push_back(text);
    result.limits.push_back(scope(n));
  }
  result.limits.push_back(
      "A small eta is no error bound: the problem is not convex, and nobody knows how far an "
      "answer is from a solution, nor from which one.");
  result.limits.push_back("Times are of this machine, these sizes and these time limits.");
  return result;
}

}  // namespace conebench::results
