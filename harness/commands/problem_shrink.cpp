#include "harness/commands/problem_shrink.h"

#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/failure.h"
#include "harness/interrupt.h"
#include "harness/settings.h"
#include "harness/shrink.h"
#include "harness/variants.h"
#include "results/text.h"

namespace conebench::harness {
namespace {

using Clock = std::chrono::steady_clock;

struct Options {
  std::string file, solver = "auto", failing, mode = "cold", output;
  std::int64_t max_iterations = solvers::Stop{}.max_iterations;
  SolveSettings settings;
  bool json = false;
};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// One line on stderr: redrawn on a terminal, written every 30 s elsewhere.
class Line {
 public:
  void show(const ShrinkState& state) {
    if (seconds_since(shown_) < (terminal_ ? 0.2 : 30.0)) return;
    shown_ = Clock::now();
    fmt::print(stderr, "{}{} of {} cones left after {} runs{}", terminal_ ? "\r\x1b[K" : "",
               state.smallest, state.cones, state.runs, terminal_ ? "" : "\n");
    std::fflush(stderr);
  }

  ~Line() {
    if (terminal_) fmt::print(stderr, "\r\x1b[K");
  }

 private:
  bool terminal_ = ::isatty(STDERR_FILENO) == 1;
  Clock::time_point shown_ = Clock::now();
};

nlohmann::json to_json(const Shrunk& shrunk, const Options& options, double time_s) {
  return {{"problem", shrunk.whole.name},
          {"solver", shrunk.first.solver},
          {"failure", shrunk.failure},
          {"status", results::to_string(shrunk.first.status)},
          {"cones_before", shrunk.cones},
          {"cones_after", shrunk.kept.size()},
          {"cones", shrunk.kept},
          {"minimal", shrunk.minimal},
          {"confirmed", shrunk.confirmed},
          {"runs", shrunk.runs},
          {"time_s", time_s},
          {"output", options.output}};
}

void print_text(const Shrunk& shrunk, const Options& options, double time_s) {
  fmt::print("problem   {} ({} cones)\n", shrunk.whole.name, shrunk.cones);
  fmt::print("solver    {}: {}\n", shrunk.first.solver, describe_run(shrunk.first));
  fmt::print("failure   {}\n", shrunk.failure);
  fmt::print("left      {} cones: {}\n", shrunk.kept.size(), ranges_text(shrunk.kept));
  fmt::print("          {}\n", shrunk.minimal
                                   ? "without any one of them it does not fail so"
                                   : "interrupted: fewer may do; go on from the file written");
  if (shrunk.minimal) fmt::print("run       {}\n", describe_run(shrunk.last));
  fmt::print("search    {} runs, {}\n", shrunk.runs, results::format_time(time_s));
  fmt::print("written   {}\n", options.output);
}

int run(const Options& options) {
  solvers::Stop stop = options.settings.checked_stop();
  stop.max_iterations = options.max_iterations;
  const ShrinkRequest request{.input = options.file,
                              .output = options.output,
                              .solver = make_solver(options.solver),
                              .stop = stop,
                              .failing = options.failing,
                              .mode = mode_from(options.mode, "--mode"),
                              .memory_limit_bytes = options.settings.memory_limit_bytes(),
                              .hard_limit_s = options.settings.hard_limit_s()};
  const auto start = Clock::now();
  const Shrunk shrunk = [&] {
    Line line;
    return shrink(request, [&](const ShrinkState& state) { line.show(state); });
  }();
  if (shrunk.kept.empty()) return kInterruptedExit;
  if (options.json) {
    const auto replace = nlohmann::json::error_handler_t::replace;
    const nlohmann::json object = to_json(shrunk, options, seconds_since(start));
    fmt::print("{}\n", object.dump(-1, ' ', false, replace));
  } else {
    print_text(shrunk, options, seconds_since(start));
  }
  if (shrunk.interrupted) return kInterruptedExit;
  if (shrunk.confirmed) return 0;
  fmt::print(stderr, "conebench: {}: read again, {} ends as {}: it does not fail in every run\n",
             options.output, shrunk.last.solver, describe_run(shrunk.last));
  return 1;
}

}  // namespace

void add_problem_shrink(CLI::App& problem, int& exit_code) {
  auto options = std::make_shared<Options>();
  options->settings.time_limit = "10s";
  CLI::App* verb = problem.add_subcommand(
      "shrink", "the fewest cones of a problem on which a solver still fails in the same way");
  verb->add_option("FILE", options->file, "Problem in any format that we can import")
      ->type_name("")
      ->required();
  verb->add_option("-s,--solver", options->solver,
                   "Variant that fails, e.g. newton-ac or plugin:FILE")
      ->type_name("SOLVER")
      ->capture_default_str();
  verb->add_option(
          "--failing", options->failing,
          "What failing is: a status such as stalled or crashed, or a condition on status, "
          "claimed, solved, eta, iterations, time, e.g. 'eta > 1e-3' (default: the status "
          "that the whole problem ends with)")
      ->type_name("STATUS|CONDITION");
  verb->add_option("--mode", options->mode,
                   "Start of every run: cold, or warm from the file's guess")
      ->check(CLI::IsMember({"cold", "warm"}))
      ->capture_default_str();
  options->settings.add_to(*verb);
  verb->add_option("--max-iterations", options->max_iterations,
                   "Of every run; unlike a time limit it ends a run alike everywhere")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  verb->add_option("-o,--output", options->output,
                   "Problem file to write; while the search runs, the smallest so far")
      ->type_name("FILE")
      ->required();
  verb->add_flag("--json", options->json, "Print one JSON object");
  verb->footer(
      "Every run is in a worker process, as in a campaign. A solver that hangs costs the hard "
      "limit\n"
      "at each of its runs: give --time-limit and --hard-limit. Interrupted, the file written "
      "holds\n"
      "the smallest part so far, to go on from.\n"
      "Exit code: 0 found, 1 the failure does not come again, 2 bad input (or no failure), 130\n"
      "interrupted.");
  verb->callback([options, &exit_code] { exit_code = run(*options); });
}

}  // namespace conebench::harness
