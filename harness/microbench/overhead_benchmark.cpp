// What a campaign adds to the time of a solve: a made-up solver that does a fixed amount of work of
// about 12 us, 1.2 ms or 1.2 s, as a task of `conebench run --reps auto` (a worker process, its
// timing core, its record) and in a bare loop around Solver::solve.
//
//   build/overhead_benchmark [PAIRS]        (default 25, at least 6; of the solves of 1.2 s a
//   fifth)
//
// A pair is two measurements in a row, in random order. From pairs of two bare loops comes the A/A
// interval: what the machine itself makes of no difference at all. From pairs of a bare loop and a
// task comes the difference. What a solve takes outside of its own clock (its call, its answer), a
// bare loop sees and a campaign does not; measured with a solver that does nothing, it is taken off
// the bare loops. Both sides take batches of as many solves: where noise is skewed, the
// median of means grows with what the means are over. Exit code 1 if a difference lies outside of
// its interval.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <random>
#include <vector>

#include "harness/median.h"
#include "harness/timing.h"
#include "harness/worker.h"

namespace conebench::harness {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kSolves_s[] = {1.2e-5, 1.2e-3, 1.2};

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

problems::Problem one_contact() {
  problems::SparseMatrix W(3, 3);
  W.setIdentity();
  return {problems::ReducedData{W, Eigen::Vector3d(-1.0, 0.25, 0.0)},
          {problems::Cone::coulomb(3, 0.5)},
          {}};
}

// Each step waits for the one before, whatever the compiler or the processor would like.
double work(std::int64_t steps) {
  double x = 0.5;
  for (std::int64_t i = 0; i < steps; ++i) x = 3.7 * x * (1.0 - x);
  return x;
}

std::int64_t steps_of(double seconds) {
  constexpr std::int64_t kTrial = 20'000'000;
  const auto start = Clock::now();
  volatile double used = work(kTrial);
  static_cast<void>(used);
  return static_cast<std::int64_t>(seconds / seconds_since(start) * static_cast<double>(kTrial));
}

solvers::Solver spinner(std::int64_t steps) {
  solvers::Solver solver;
  solver.name = "spinner";
  solver.refuses = [](const problems::Problem&) { return std::optional<std::string>(); };
  solver.solve = [steps](const problems::Problem& standard, const solvers::Request& request) {
    std::optional<solvers::Monitor> own;
    solvers::Monitor& monitor =
        request.monitor ? *request.monitor : own.emplace(standard, request.stop);
    monitor.setup_done();
    solvers::Result result;
    result.r = Eigen::Vector3d(work(steps), 0.0, 0.0);
    result.status = solvers::Status::kStalled;
    result.setup_s = monitor.setup_s();
    result.solve_s = monitor.elapsed_s() - monitor.setup_s();
    return result;
  };
  return solver;
}

// Repeats of time_solves(): how many solves make a batch (a power of ten, as Google Benchmark tries
// them; kSolves_s keep clear of the edges), and when there are enough of them.
std::int64_t batch_of(double about_s) {
  return std::llround(std::pow(10.0, std::ceil(std::log10(std::max(1.0, kSample_s / about_s)))));
}

bool enough(const std::vector<double>& times_s) {
  const Repeats rules;
  return static_cast<std::int64_t>(times_s.size()) >= rules.most ||
         median_interval(times_s).spread() <= rules.spread_goal;
}

// Seconds of one solve by a clock outside: the median of as many batches as time_solves() takes, or
// one solve where it takes one.
double bare_loop(const solvers::Solver& solver, const problems::Problem& problem, double about_s) {
  const Repeats rules;
  const bool once = about_s > 0.5 * rules.budget_s;
  const std::int64_t batch = once ? 1 : batch_of(about_s);
  if (!once) static_cast<void>(solver.solve(problem, {}));
  std::vector<double> times_s;
  const auto begin = Clock::now();
  do {
    const auto start = Clock::now();
    for (std::int64_t i = 0; i < batch; ++i) static_cast<void>(solver.solve(problem, {}));
    times_s.push_back(seconds_since(start) / static_cast<double>(batch));
  } while (!once && !enough(times_s) && seconds_since(begin) < rules.budget_s);
  return median_interval(times_s).median;
}

// What a solve takes outside of its own clock, call and answer included, as a bare loop sees it.
double outside_of_clock(const problems::Problem& problem) {
  const solvers::Solver nothing = spinner(0);
  std::vector<double> inside_s;
  for (int solve = 0; solve < 1000; ++solve) {
    const solvers::Result result = nothing.solve(problem, {});
    inside_s.push_back(result.setup_s + result.solve_s);
  }
  return bare_loop(nothing, problem, 1e-6) - median_interval(std::move(inside_s)).median;
}

double through_run(const solvers::Solver& solver, const problems::Problem& problem) {
  const ProblemSource source{.id = {.name = "one-contact", .content_sha256 = "one-contact"},
                             .load = [problem] { return only(problem); }};
  const auto record =
      run_task({.problems = {source}, .solver = solver, .repeat_for_confidence = true});
  return record->setup_s + record->solve_s;
}

// Relative differences of two ways to measure the same, second over first.
std::vector<double> differences(const std::function<double()>& first,
                                const std::function<double()>& second, int pairs) {
  std::mt19937_64 random(1);
  std::vector<double> values;
  for (int pair = 0; pair < pairs; ++pair) {
    const bool swapped = random() % 2 == 1;
    const double early = swapped ? second() : first();
    const double late = swapped ? first() : second();
    values.push_back(swapped ? early / late - 1.0 : late / early - 1.0);
  }
  return values;
}

bool compare(double about_s, std::int64_t steps, int pairs) {
  const problems::Problem problem = one_contact();
  const solvers::Solver solver = spinner(steps);
  const double outside_s = outside_of_clock(problem);
  const auto bare = [&] { return bare_loop(solver, problem, about_s) - outside_s; };
  const auto timed = [&] { return through_run(solver, problem); };
  const std::vector<double> noise = differences(bare, bare, pairs);
  const MedianInterval difference = median_interval(differences(bare, timed, pairs));
  // No sign is meant: two equal loops have no first.
  std::vector<double> sizes;
  for (const double value : noise) sizes.push_back(std::abs(value));
  std::sort(sizes.begin(), sizes.end());
  const double bound = sizes[static_cast<std::size_t>(0.95 * static_cast<double>(pairs - 1))];
  const bool inside = std::abs(difference.median) <= bound;
  fmt::print("{:>8.3g} s   A/A within +-{:.3f} %   run {:+.3f} % [{:+.3f}, {:+.3f}]   {}\n",
             about_s, 100.0 * bound, 100.0 * difference.median, 100.0 * difference.low,
             100.0 * difference.high, inside ? "inside" : "OUTSIDE");
  return inside;
}

}  // namespace
}  // namespace conebench::harness

int main(int argc, char** argv) {
  const int pairs = argc > 1 ? std::max(6, std::atoi(argv[1])) : 25;
  const std::int64_t steps_of_1_s = conebench::harness::steps_of(1.0);
  bool all_inside = true;
  for (const double about_s : conebench::harness::kSolves_s) {
    const auto steps = static_cast<std::int64_t>(about_s * static_cast<double>(steps_of_1_s));
    const int as_many = about_s < 0.1 ? pairs : std::max(6, pairs / 5);
    all_inside &= conebench::harness::compare(about_s, steps, as_many);
  }
  return all_inside ? 0 : 1;
}
