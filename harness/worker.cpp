#include "harness/worker.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <cmath>
#include <csignal>
#include <nlohmann/json.hpp>

#include "harness/error_text.h"
#include "harness/host.h"
#include "harness/judge.h"
#include "harness/problem_id.h"
#include "problems/problem_file.h"
#include "solvers/monitor.h"

namespace conebench::harness {
namespace {

using nlohmann::json;
using results::Record;
using results::Status;

constexpr double kLoadAllowance_s = 30.0;

// ---- In the worker.

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

solvers::Result solve(const Task& task, const problems::Problem& standard, Record& record) {
  if (const auto reason = task.solver.refuses ? task.solver.refuses(standard) : std::nullopt) {
    solvers::Result refusal;
    refusal.notes = {*reason};
    return refusal;
  }
  solvers::Monitor monitor(standard, task.stop);
  solvers::Request request{.stop = task.stop, .guess = {}, .monitor = &monitor};
  solvers::Result result = task.solver.solve(standard, request);
  for (const auto& p : monitor.curve()) record.curve.push_back({p.time_s, p.iteration, p.eta});
  return result;
}

void fail(Record& record, Status status, const std::string& error) {
  record.status = status;
  record.error = error;
}

Record attempt(const Task& task) {
  Record record = blank_record(task);
  const problems::Problem problem = task.load();
  complete(record.problem, problem);
  const problems::Problem standard = problem.shifted();
  std::optional<solvers::Result> result;
  try {
    result = solve(task, standard, record);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    fail(record, Status::kCrashed, fmt::format("the solver threw: {}", error.what()));
    return record;
  }
  judge(standard, *result, record);
  if (task.solution_file && std::isfinite(record.eta)) {
    write_solution(*task.solution_file, problem, standard, result->r, record.eta);
  }
  return record;
}

std::string dump(const json& message) {
  return message.dump(-1, ' ', false, json::error_handler_t::replace);
}

std::string work(const Task& task) {
  try {
    return dump({{"record", to_json(attempt(task))}});
  } catch (const problems::InputError& error) {
    return dump({{"input_error", error.what()}, {"subject", error.subject()}});
  } catch (const problems::OutputError& error) {
    return dump({{"output_error", error.what()}});
  } catch (const std::bad_alloc&) {
    lift_memory_limit();
    Record record = blank_record(task);
    fail(record, Status::kKilledMemory, "an allocation failed");
    return dump({{"record", to_json(record)}});
  }
}

// ---- In the parent.

// The worker left no message.
void explain_death(const ChildOutcome& outcome, Record& record) {
  if (outcome.timed_out || outcome.signal == SIGXCPU) {
    fail(record, Status::kKilledTime, "at the hard limit: " + describe_end(outcome));
  } else if (outcome.errors.find("std::bad_alloc") != std::string::npos) {
    fail(record, Status::kKilledMemory, "an allocation failed");
  } else if (outcome.signal == SIGKILL) {
    fail(record, Status::kKilledMemory, "killed by the system, most likely out of memory");
  } else {
    fail(record, Status::kCrashed, "ended without an answer: " + describe_end(outcome));
  }
}

Record decoded(const json& message) {
  if (message.contains("input_error")) {
    throw input_error(message["input_error"], message["subject"]);
  }
  if (message.contains("output_error")) {
    throw problems::OutputError("solution", std::string(message["output_error"]));
  }
  return results::record_from_json(message.at("record"), "worker");
}

}  // namespace

double default_hard_limit_s(double time_limit_s) { return 2.0 * time_limit_s + kLoadAllowance_s; }

Record blank_record(const Task& task) {
  static const results::Host host = current_host();
  Record record;
  record.problem = task.problem;
  record.solver = task.solver.name;
  record.kind = solvers::to_string(task.solver.kind);
  record.settings = {.tol = task.stop.tol,
                     .time_limit_s = task.stop.time_limit_s,
                     .memory_limit_bytes = task.memory_limit_bytes,
                     .stop = task.stop.test == solvers::StopTest::kOwn ? "own" : "common"};
  record.repetition = task.repetition;
  record.started_at = utc_now();
  record.host = host;
  return record;
}

Job job_of(const Task& task) {
  return {
      .work = [task] { return work(task); },
      .limits = {.wall_s = task.hard_limit_s.value_or(default_hard_limit_s(task.stop.time_limit_s)),
                 .memory_bytes = task.memory_limit_bytes}};
}

Record record_of(const Task& task, const ChildOutcome& outcome) {
  const json message = json::parse(outcome.output, nullptr, false);
  Record record = blank_record(task);
  if (message.is_discarded()) {
    record.started_at = utc_now(outcome.wall_s);
    explain_death(outcome, record);
  } else {
    record = decoded(message);
  }
  record.wall_s = outcome.wall_s;
  record.cpu_s = outcome.cpu_s;
  record.peak_memory_bytes = outcome.peak_memory_bytes;
  return record;
}

std::optional<Record> run_task(const Task& task) {
  std::optional<Record> record;
  run_pool(1, 1,
           {.make = [&](std::size_t) { return job_of(task); },
            .done = [&](std::size_t, const ChildOutcome& o) { record = record_of(task, o); },
            .tick = {}});
  return record;
}

}  // namespace conebench::harness
