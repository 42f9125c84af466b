#include "harness/worker.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "harness/error_text.h"
#include "harness/host.h"
#include "harness/judge.h"
#include "harness/plugin_library.h"
#include "harness/solver_build.h"
#include "harness/timing.h"
#include "problems/carry_over.h"
#include "problems/problem_file.h"
#include "problems/residual.h"
#include "solvers/linear/threads.h"

namespace conebench::harness {
namespace {

using nlohmann::json;
using results::Record;
using results::Status;

constexpr double kLoadAllowance_s = 30.0;
constexpr double kLastWords_s = 1.0;  // between the soft and the hard limit

// ---- In the worker.

Eigen::VectorXd zero_reaction(const problems::Problem& standard) {
  return Eigen::VectorXd::Zero(standard.rows());
}

void lift_memory_limit() {
  rlimit limit{};
  ::getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_AS, &limit);
}

void write_solution(const std::filesystem::path& path, const problems::Problem& problem,
                    const problems::Problem& standard, const Eigen::VectorXd& r, double eta) {
  problems::Solution solution{.r = r, .u = standard.rate(r), .v = {}, .eta = eta};
  if (standard.is_primal()) solution.v = standard.velocity(r);
  problems::write_solution_file(path, problem, solution);
}

void fail(Record& record, Status status, const std::string& error) {
  record.status = status;
  record.error = error;
}

TimedSolves solve(const Task& task, const problems::Problem& standard,
                  const Eigen::VectorXd& guess) {
  if (const auto reason = task.solver->refuses ? task.solver->refuses(standard) : std::nullopt) {
    TimedSolves refusal;
    refusal.result.notes = {*reason};
    return refusal;
  }
  return time_solves(*task.solver, standard, guess, task.stop,
                     {.by_confidence = task.repeat_for_confidence});
}

void write_cost(const TimedSolves& timed, Record& record) {
  for (const auto& p : timed.curve) record.curve.push_back({p.time_s, p.iteration, p.eta});
  record.setup_s = timed.setup_s;
  record.solve_s = timed.solve_s;
  record.timed_solves = timed.solves;
  record.time_spread = timed.spread;
  record.solver_cpu_s = timed.cpu_s;
  record.allocations = timed.allocations;
  record.solver_memory_bytes = timed.memory_bytes;
  record.peak_memory_bytes = timed.process_peak_bytes;
}

// Solves, judges and writes into the record; the answer, or nothing of use.
Eigen::VectorXd answer(const Task& task, const problems::Problem& problem,
                       const problems::Problem& standard, const Eigen::VectorXd& guess,
                       Record& record) {
  record.guess_eta =
      problems::evaluate_eta(standard, guess.size() > 0 ? guess : zero_reaction(standard));
  TimedSolves timed;
  try {
    timed = solve(task, standard, guess);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const BadAbi& error) {
    fail(record, Status::kBadAbi, error.what());
    return {};
  } catch (const std::exception& error) {
    fail(record, Status::kCrashed, fmt::format("the solver threw: {}", error.what()));
    return {};
  }
  judge(standard, timed.result, record);
  write_cost(timed, record);
  if (!std::isfinite(record.eta)) return {};
  const Eigen::VectorXd& r = timed.result.r;
  if (task.solution_file) write_solution(*task.solution_file, problem, standard, r, record.eta);
  return r;
}

// One step of a sequence: where its problem lies, and the answers that came out of it.
struct Step {
  problems::ProblemFile file;
  Eigen::VectorXd own, donated;  // empty: none of use
};

Eigen::VectorXd carried(const std::optional<Step>& before, const Eigen::VectorXd Step::*answers,
                        const problems::ProblemFile& now) {
  if (!before || ((*before).*answers).size() == 0) return {};
  return problems::carry_over(before->file, (*before).*answers, now);
}

// The donor's answer, of which nobody judges but the receiver's success; any failure is no answer.
Eigen::VectorXd donation(const Task& task, const problems::Problem& standard,
                         const Eigen::VectorXd& guess) {
  const solvers::Solver& donor = **task.donor;
  try {
    if (donor.refuses && donor.refuses(standard)) return {};
    const solvers::Result result =
        donor.solve(standard, {.stop = task.stop, .guess = guess, .monitor = nullptr});
    const bool usable = result.r.size() == standard.rows() && result.r.allFinite();
    return usable ? result.r : Eigen::VectorXd();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return {};
  }
}

std::vector<Record> attempt(const Task& task) {
  std::vector<Record> records = blank_records(task);
  std::optional<Step> before;
  for (std::size_t k = 0; k < records.size(); ++k) {
    Step step{.file = (*task.problems)[k].load(), .own = {}, .donated = {}};
    const problems::Problem& problem = step.file.problem;
    complete(records[k].problem, problem);
    const problems::Problem standard = problem.shifted();
    Eigen::VectorXd guess;
    if (task.mode == Mode::kWarm) guess = step.file.guess;
    if (task.mode == Mode::kSequence) {
      guess = carried(before, task.donor ? &Step::donated : &Step::own, step.file);
    }
    step.own = answer(task, problem, standard, guess, records[k]);
    if (task.donor) {
      step.donated = donation(task, standard, carried(before, &Step::donated, step.file));
    }
    before = std::move(step);
  }
  return records;
}

json to_json(const std::vector<Record>& records) {
  json list = json::array();
  for (const Record& record : records) list.push_back(results::to_json(record));
  return list;
}

std::string dump(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string work(const Task& task) {
  try {
    solvers::pin_library_threads(task.threads);
    return dump({{"records", to_json(attempt(task))}});
  } catch (const problems::InputError& error) {
    return dump({{"input_error", error.what()}, {"subject", error.subject()}});
  } catch (const problems::OutputError& error) {
    return dump({{"output_error", error.what()}});
  } catch (const std::bad_alloc&) {
    lift_memory_limit();
    std::vector<Record> records = blank_records(task);
    for (Record& record : records) fail(record, Status::kKilledMemory, "an allocation failed");
    return dump({{"records", to_json(records)}});
  }
}

// ---- In the parent.

// The worker left no message.
void explain_death(const ChildOutcome& outcome, Record& record) {
  if (outcome.timed_out || outcome.signal == SIGXCPU) {
    fail(record, Status::kKilledTime, "at the hard limit: " + describe_end(outcome));
  } else if (outcome.out_of_memory) {
    fail(record, Status::kKilledMemory, "killed at its limit of memory");
  } else if (outcome.errors.find("std::bad_alloc") != std::string::npos) {
    fail(record, Status::kKilledMemory, "an allocation failed");
  } else if (outcome.signal == SIGKILL) {
    fail(record, Status::kKilledMemory, "killed by the system, most likely out of memory");
  } else {
    fail(record, Status::kCrashed, "ended without an answer: " + describe_end(outcome));
  }
}

std::vector<Record> decoded(const json& message) {
  if (message.contains("input_error")) {
    throw input_error(message["input_error"], message["subject"]);
  }
  if (message.contains("output_error")) {
    throw problems::OutputError("solution", std::string(message["output_error"]));
  }
  std::vector<Record> records;
  for (const json& record : message.at("records")) {
    records.push_back(results::record_from_json(record, "worker"));
  }
  return records;
}

// What a solver that failed has last said on stderr, in one line.
std::string last_words(std::string errors) {
  constexpr std::size_t kKept = 300;
  while (!errors.empty() && std::isspace(static_cast<unsigned char>(errors.back()))) {
    errors.pop_back();
  }
  if (errors.size() > kKept) errors.erase(0, errors.size() - kKept);
  return "stderr: " + errors.substr(errors.rfind('\n') + 1);
}

// "mpm/sand-column, steps 3 to 12", and what identifies it.
results::SequencePlace sequence_of(const Task& task) {
  if (task.mode != Mode::kSequence) return {};
  const ProblemSource &first = task.problems->front(), &last = task.problems->back();
  std::string contents;
  for (const ProblemSource& problem : *task.problems) contents += problem.id.content_sha256 + "\n";
  return {.name = fmt::format("{}, steps {} to {}", first.id.family, first.step, last.step),
          .id = results::short_hash(contents),
          .index = 0,
          .length = static_cast<int>(task.problems->size())};
}

}  // namespace

double default_hard_limit_s(double time_limit_s) { return 2.0 * time_limit_s + kLoadAllowance_s; }

std::vector<Record> blank_records(const Task& task) {
  static const results::Host host = current_host();
  Record record;
  record.solver = task.solver->name;
  record.solver_build = build_of(*task.solver);
  record.kind = solvers::to_string(task.solver->kind);
  record.settings = {.tol = task.stop.tol,
                     .time_limit_s = task.stop.time_limit_s,
                     .memory_limit_bytes = task.memory_limit_bytes,
                     .stop = task.stop.test == solvers::StopTest::kOwn ? "own" : "common",
                     .mode = std::string(to_string(task.mode)),
                     .threads = task.threads,
                     .timing = task.repeat_for_confidence ? "repeated" : "once"};
  record.repetition = task.repetition;
  record.sequence = sequence_of(task);
  if (task.donor) record.donor = (*task.donor)->name;
  record.started_at = utc_now();
  record.host = host;
  std::vector<Record> records(task.problems->size(), record);
  for (std::size_t k = 0; k < records.size(); ++k) {
    records[k].problem = (*task.problems)[k].id;
    records[k].sequence.index = static_cast<int>(k);
  }
  return records;
}

Job job_of(const Task& task) {
  const double each = task.hard_limit_s.value_or(default_hard_limit_s(task.stop.time_limit_s));
  const double solvers_of_a_step = task.donor ? 2.0 : 1.0;
  const double limit = each * solvers_of_a_step * static_cast<double>(task.problems->size());
  const double cpu = limit * task.threads;
  return {.work = [task] { return work(task); },
          .limits = {.wall_s = limit + kLastWords_s,
                     .memory_bytes = task.memory_limit_bytes,
                     .soft_wall_s = limit,
                     .cpu_s = cpu + 2.0 * kLastWords_s,
                     .soft_cpu_s = cpu + kLastWords_s}};
}

std::vector<Record> records_of(const Task& task, const ChildOutcome& outcome) {
  const json message = json::parse(outcome.output, nullptr, false);
  std::vector<Record> records;
  if (message.is_discarded()) {
    records = blank_records(task);
    for (Record& record : records) {
      record.started_at = utc_now(outcome.wall_s);
      explain_death(outcome, record);
    }
  } else {
    records = decoded(message);
  }
  for (Record& record : records) {
    record.wall_s = outcome.wall_s;
    record.cpu_s = outcome.cpu_s;
    record.peak_memory_bytes = std::max(record.peak_memory_bytes, outcome.peak_memory_bytes);
    const bool well = record.solved() && record.status != Status::kDiverged;
    if (well || !record.error.empty() || outcome.errors.empty()) continue;
    record.error = last_words(outcome.errors);
  }
  return records;
}

std::optional<Record> run_task(const Task& task) {
  std::optional<Record> record;
  run_pool(
      1, 1,
      {.make = [&](std::size_t) { return job_of(task); },
       .done = [&](std::size_t,
                   const ChildOutcome& outcome) { record = records_of(task, outcome).front(); },
       .tick = {}});
  return record;
}

}  // namespace conebench::harness
