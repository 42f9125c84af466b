// What time_solves() adds to a solve: a made-up solver that does a fixed amount of work of about
// 10 us, 1 ms or 1 s, through time_solves() and in a bare loop around Solver::solve.
//
//   build/overhead_benchmark [PAIRS]        (default 25, at least 6; of the solves of 1 s a fifth)
//
// A pair is two measurements in a row, in random order. From pairs of two bare loops comes the A/A
// interval: what the machine itself makes of no difference at all. From pairs of a bare loop and
// time_solves() comes the difference. Exit code 1 if a difference lies outside of its interval.

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

namespace conebench::harness {
namespace {

using Clock = std::chrono::steady_clock;

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

// Seconds of one solve: the median of batches like those of time_solves(), by a clock outside.
double bare_loop(const solvers::Solver& solver, const problems::Problem& problem, double about_s) {
  const auto batch = static_cast<int>(std::ceil(std::max(1.0, kSample_s / about_s)));
  const int samples = about_s < 0.1 ? 15 : 1;
  std::vector<double> times_s;
  static_cast<void>(solver.solve(problem, {}));
  for (int sample = 0; sample < samples; ++sample) {
    const auto start = Clock::now();
    for (int i = 0; i < batch; ++i) static_cast<void>(solver.solve(problem, {}));
    times_s.push_back(seconds_since(start) / batch);
  }
  return median_interval(times_s).median;
}

double through_time_solves(const solvers::Solver& solver, const problems::Problem& problem,
                           double about_s) {
  const TimedSolves timed = time_solves(solver, problem, {}, {},
                                        {.by_confidence = true,
                                         .spread_goal = 1e-9,
                                         .most = about_s < 0.1 ? 15 : 1,
                                         .budget_s = 60.0});
  return timed.setup_s + timed.solve_s;
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
  const auto bare = [&] { return bare_loop(solver, problem, about_s); };
  const auto timed = [&] { return through_time_solves(solver, problem, about_s); };
  const std::vector<double> noise = differences(bare, bare, pairs);
  const MedianInterval difference = median_interval(differences(bare, timed, pairs));
  // No sign is meant: two equal loops have no first.
  std::vector<double> sizes;
  for (const double value : noise) sizes.push_back(std::abs(value));
  std::sort(sizes.begin(), sizes.end());
  const double bound = sizes[static_cast<std::size_t>(0.95 * static_cast<double>(pairs - 1))];
  const bool inside = std::abs(difference.median) <= bound;
  fmt::print("{:>8.3g} s   A/A within +-{:.3f} %   time_solves {:+.3f} % [{:+.3f}, {:+.3f}]   {}\n",
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
  for (const double about_s : {1e-5, 1e-3, 1.0}) {
    const auto steps = static_cast<std::int64_t>(about_s * static_cast<double>(steps_of_1_s));
    const int as_many = about_s < 0.1 ? pairs : std::max(6, pairs / 5);
    all_inside &= conebench::harness::compare(about_s, steps, as_many);
  }
  return all_inside ? 0 : 1;
}
