#include "harness/shrink.h"

#include <fmt/format.h>

#include <numeric>

#include "harness/ddmin.h"
#include "harness/failure.h"
#include "problems/error.h"
#include "problems/load.h"
#include "problems/part.h"

namespace conebench::harness {
namespace {

using problems::Metadata;
using problems::ProblemFile;
using results::Record;

constexpr std::size_t kLongestList = 2000;  // characters of an origin; an attribute holds 64 KiB

// One search: the whole problem, its runs, and the file of the smallest part so far.
class Search {
 public:
  Search(const ShrinkRequest& request, const std::function<void(const ShrinkState&)>& watch)
      : request_(request), watch_(watch), whole_(problems::load_problem(request.input)) {
    const auto& output = request.output;
    problems::require(
        !std::filesystem::exists(output) || !std::filesystem::equivalent(output, request.input),
        output.string(), "is the problem itself, expected another file");
    problems::require(request.mode == Mode::kCold || whole_.guess.size() > 0,
                      request.input.string(), "has no guess, expected one to start from");
    problems::require(whole_.problem.cone_count() > 0, request.input.string(),
                      "has no cones, expected some to leave out");
    state_.cones = state_.smallest = whole_.problem.cone_count();
  }

  Shrunk run() {
    Shrunk result{.whole = whole_.problem.metadata(), .cones = state_.cones};
    const std::optional<Record> first = solve(whole_source());
    result.interrupted = !first.has_value();
    if (!first) return result;
    result.first = *first;
    const Failure failure(request_.failing, *first);
    result.failure = failure.text();

    std::vector<int> all(static_cast<std::size_t>(state_.cones));
    std::iota(all.begin(), all.end(), 0);
    write(all, result);
    const Minimum found = minimise(all, [&](const std::vector<int>& cones) {
      const std::optional<bool> fails = still_fails(cones, failure);
      if (fails.value_or(false)) write(cones, result);
      return fails;
    });
    result.kept = found.items;
    result.minimal = found.complete;
    confirm(failure, result);
    result.runs = state_.runs;
    return result;
  }

 private:
  std::optional<Record> solve(const ProblemSource& source) {
    const std::optional<Record> record =
        run_task({.problems = {source},
                  .solver = request_.solver,
                  .stop = request_.stop,
                  .mode = request_.mode,
                  .memory_limit_bytes = request_.memory_limit_bytes,
                  .hard_limit_s = request_.hard_limit_s});
    state_.runs += record.has_value() ? 1 : 0;
    if (watch_) watch_(state_);
    return record;
  }

  // Its id is complete: a worker that dies cannot fill it in.
  ProblemSource whole_source() const {
    ProblemSource source{.id = {.path = request_.input.string()},
                         .load = [this] { return whole_; }};
    complete(source.id, whole_.problem);
    return source;
  }

  std::optional<bool> still_fails(const std::vector<int>& cones, const Failure& failure) {
    const ProblemSource part{.id = {}, .load = [this, &cones] {
                               return problems::part_of(whole_, cones, whole_.problem.metadata());
                             }};
    try {
      const std::optional<Record> record = solve(part);
      if (!record) return std::nullopt;
      return failure.seen_in(*record);
    } catch (const problems::InputError&) {
      return false;
    }
  }

  void write(const std::vector<int>& cones, const Shrunk& result) {
    problems::write_problem_file(request_.output,
                                 problems::part_of(whole_, cones, part_metadata(cones, result)));
    state_.smallest = static_cast<int>(cones.size());
  }

  Metadata part_metadata(const std::vector<int>& cones, const Shrunk& result) const {
    Metadata metadata = result.whole;
    metadata.name = fmt::format("{}/{}_of_{}_cones", result.whole.name, cones.size(), state_.cones);
    metadata.sampling_weight = Metadata{}.sampling_weight;
    std::string list = ": " + ranges_text(cones);
    if (list.size() > kLongestList) list.clear();
    metadata.origin = fmt::format(
        "{} of the {} cones of {} (content_sha256 {}){}; {} at tol {:g} fails on them: {}",
        cones.size(), state_.cones, result.whole.name, result.first.problem.content_sha256, list,
        result.first.solver, request_.stop.tol, result.failure);
    if (!result.whole.origin.empty()) metadata.origin += "; the whole: " + result.whole.origin;
    return metadata;
  }

  void confirm(const Failure& failure, Shrunk& result) {
    if (result.minimal) {
      if (const std::optional<Record> last = solve(source_from_file(request_.output))) {
        result.last = *last;
        result.confirmed = failure.seen_in(*last);
        return;
      }
    }
    result.interrupted = true;
  }

  const ShrinkRequest& request_;
  const std::function<void(const ShrinkState&)>& watch_;
  ProblemFile whole_;
  ShrinkState state_;
};

}  // namespace

Shrunk shrink(const ShrinkRequest& request, const std::function<void(const ShrinkState&)>& watch) {
  return Search(request, watch).run();
}

std::string ranges_text(const std::vector<int>& numbers) {
  std::string text;
  for (std::size_t first = 0; first < numbers.size();) {
    std::size_t last = first;
    while (last + 1 < numbers.size() && numbers[last + 1] == numbers[last] + 1) ++last;
    if (last - first < 2) last = first;
    text += fmt::format("{}{}", text.empty() ? "" : ", ", numbers[first]);
    if (last > first) text += fmt::format("-{}", numbers[last]);
    first = last + 1;
  }
  return text;
}

}  // namespace conebench::harness
