#include "harness/timing.h"

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <ctime>
#include <limits>
#include <optional>

#include "harness/allocations.h"
#include "harness/median.h"
#include "harness/memory_growth.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double seconds(const timeval& t) {
  return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
}

// Of this process, all of its threads. [s]
double processor_time_s() {
  timespec time{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// Of its children that have ended. [s]
double processor_time_of_children_s() {
  rusage children{};
  ::getrusage(RUSAGE_CHILDREN, &children);
  return seconds(children.ru_utime) + seconds(children.ru_stime);
}

struct Attempt {
  solvers::Result result;
  std::vector<solvers::CurvePoint> curve;
  double looks_cpu_s = 0.0;       // processor time of the looks at eta
  std::uint64_t allocations = 0;  // 0 unless they are counted
};

// Processor time since it was made, of this process and the children that it has waited for. Asking
// for it enters the system, after which the next microseconds run slower: never before each solve.
class ProcessorClock {
 public:
  double elapsed_s() const { return now_s() - start_s_; }

 private:
  static double now_s() { return processor_time_s() + processor_time_of_children_s(); }
  double start_s_ = now_s();
};

struct Question {
  const solvers::Solver& solver;
  const problems::Problem& standard;
  solvers::Request request;

  // The looks at eta are neither the solver's processor time nor its allocations.
  Attempt ask(bool count_allocations) {
    Attempt attempt;
    std::optional<AllocationCount> allocations;
    if (count_allocations) allocations.emplace();
    solvers::Monitor monitor(standard, request.stop);  // starts the clock
    monitor.on_look([&](bool begins) {
      attempt.looks_cpu_s += begins ? -processor_time_s() : processor_time_s();
      if (allocations) begins ? allocations->pause() : allocations->resume();
    });
    request.monitor = &monitor;
    attempt.result = solver.solve(standard, request);
    if (allocations) attempt.allocations = allocations->calls();
    allocations.reset();
    attempt.curve = monitor.curve();
    return attempt;
  }
};

double total_s(const solvers::Result& result) { return result.setup_s + result.solve_s; }

bool same_answer(const solvers::Result& a, const solvers::Result& b) {
  if (a.status == solvers::Status::kTimeLimit || b.status == solvers::Status::kTimeLimit) {
    return true;  // no two of them get equally far
  }
  const auto bytes = static_cast<std::size_t>(a.r.size()) * sizeof(double);
  return a.r.size() == b.r.size() &&
         (bytes == 0 || std::memcmp(a.r.data(), b.r.data(), bytes) == 0);
}

class LastRun : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context&) override { return true; }
  void ReportRuns(const std::vector<Run>& runs) override { run = runs.at(0); }

  Run run;
};

// Means over a batch, each of one solve.
struct Sample {
  double setup_s = 0.0, solve_s = 0.0, cpu_s = 0.0;
};

// Batches of solves, one after the other.
class Batches {
 public:
  Batches(Question& question, const solvers::Result& first, Clock::time_point deadline)
      : question_(question), first_(first), deadline_(deadline) {}
  ~Batches() { benchmark::ClearRegisteredBenchmarks(); }
  Batches(const Batches&) = delete;
  Batches& operator=(const Batches&) = delete;

  // Nothing when the deadline came first.
  std::optional<Sample> next() {
    benchmark::ClearRegisteredBenchmarks();
    auto* const batch =
        benchmark::RegisterBenchmark("solve", [this](benchmark::State& state) { run(state); });
    batch->UseManualTime()->Unit(benchmark::kSecond)->Repetitions(1);
    size_ == 0 ? batch->MinTime(kSample_s) : batch->Iterations(size_);
    LastRun last;
    benchmark::RunSpecifiedBenchmarks(&last, "all");
    if (last.run.error_occurred) return std::nullopt;
    size_ = last.run.iterations;
    solves_ += size_;
    const double setup_s = last.run.counters["setup_s"];
    return Sample{.setup_s = setup_s,
                  .solve_s = last.run.GetAdjustedRealTime() - setup_s,
                  .cpu_s = last.run.counters["cpu_s"]};
  }

  std::int64_t solves() const { return solves_; }
  bool answers_agree() const { return answers_agree_; }

 private:
  void run(benchmark::State& state) {
    double setup_s = 0.0, looks_cpu_s = 0.0;
    const ProcessorClock processor;
    for (auto _ : state) {
      if (Clock::now() > deadline_) {
        state.SkipWithError("no time left");
        break;
      }
      const Attempt attempt = question_.ask(false);
      state.SetIterationTime(total_s(attempt.result));
      setup_s += attempt.result.setup_s;
      looks_cpu_s += attempt.looks_cpu_s;
      if (!same_answer(attempt.result, first_)) answers_agree_ = false;
    }
    state.counters["setup_s"] = {setup_s, benchmark::Counter::kAvgIterations};
    state.counters["cpu_s"] = {processor.elapsed_s() - looks_cpu_s,
                               benchmark::Counter::kAvgIterations};
  }

  Question& question_;
  const solvers::Result& first_;
  Clock::time_point deadline_;
  std::int64_t size_ = 0, solves_ = 0;
  bool answers_agree_ = true;
};

double median(const std::vector<Sample>& samples, double (*value)(const Sample&)) {
  std::vector<double> values;
  for (const Sample& sample : samples) values.push_back(value(sample));
  return median_interval(std::move(values)).median;
}

double spread(const std::vector<Sample>& samples) {
  std::vector<double> totals;
  for (const Sample& sample : samples) totals.push_back(sample.setup_s + sample.solve_s);
  return median_interval(std::move(totals)).spread();
}

// Replaces the times of the first solve by those of its repeats, as many as the rules allow.
void repeat(Question& question, const Repeats& repeats, Clock::time_point start,
            TimedSolves& timed) {
  const auto budget =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(repeats.budget_s));
  Batches batches(question, timed.result, start + budget);
  std::vector<Sample> samples;
  double longest_s = seconds_since(start);
  while (static_cast<std::int64_t>(samples.size()) < repeats.most &&
         seconds_since(start) + longest_s <= repeats.budget_s) {
    const auto begin = Clock::now();
    const std::optional<Sample> sample = batches.next();
    if (!sample) break;
    longest_s = samples.empty() ? seconds_since(begin) : std::max(longest_s, seconds_since(begin));
    samples.push_back(*sample);
    if (spread(samples) <= repeats.spread_goal) break;
  }
  if (samples.empty()) return;
  const double first_s = total_s(timed.result);
  timed.setup_s = median(samples, [](const Sample& s) { return s.setup_s; });
  timed.solve_s = median(samples, [](const Sample& s) { return s.solve_s; });
  timed.cpu_s = median(samples, [](const Sample& s) { return s.cpu_s; });
  for (solvers::CurvePoint& point : timed.curve) {
    point.time_s *= (timed.setup_s + timed.solve_s) / first_s;
  }
  timed.spread = spread(samples);
  timed.solves = batches.solves();
  if (!batches.answers_agree()) {
    timed.result.notes.push_back("not deterministic: r differs between repeats");
  }
}

TimedSolves first_solve(Question& question) {
  TimedSolves timed;
  const MemoryGrowth memory;
  const ProcessorClock processor;
  Attempt attempt = question.ask(true);
  timed.cpu_s = processor.elapsed_s() - attempt.looks_cpu_s;
  timed.memory_bytes = memory.bytes();
  timed.process_peak_bytes = memory.process_peak_bytes();
  timed.result = std::move(attempt.result);
  timed.curve = std::move(attempt.curve);
  timed.setup_s = timed.result.setup_s;
  timed.solve_s = timed.result.solve_s;
  timed.allocations = attempt.allocations;
  timed.spread = std::numeric_limits<double>::infinity();
  return timed;
}

}  // namespace

void Repeats::check() const {
  problems::require(spread_goal > 0.0, "repeats", "spread_goal = ", spread_goal, ", expected > 0");
  problems::require(most >= 1, "repeats", "most = ", most, ", expected >= 1");
  problems::require(budget_s > 0.0, "repeats", "budget_s = ", budget_s, ", expected > 0");
}

TimedSolves time_solves(const solvers::Solver& solver, const problems::Problem& standard,
                        const Eigen::VectorXd& guess, const solvers::Stop& stop,
                        const Repeats& repeats) {
  repeats.check();
  const auto start = Clock::now();
  Question question{.solver = solver,
                    .standard = standard,
                    .request = {.stop = stop, .guess = guess, .monitor = nullptr}};
  TimedSolves timed = first_solve(question);
  // A clock that stands still would let Google Benchmark repeat for ever.
  if (repeats.by_confidence && total_s(timed.result) > 0.0) repeat(question, repeats, start, timed);
  return timed;
}

}  // namespace conebench::harness
