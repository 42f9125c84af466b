#include "results/gbench.h"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "results/builds.h"
#include "results/profiles.h"

namespace conebench::results {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kNanosecondsPerSecond = 1e9;

bool in_time(const Record& record) {
  return std::isfinite(time_to_tolerance(record, record.settings.tol));
}

std::string run_name(const Record& record, const std::string& solver) {
  const Settings& s = record.settings;
  std::string name = fmt::format("{}/{}@{}/tol:{:.0e}", solver, record.problem.name,
                                 record.problem.content_sha256.substr(0, 8), s.tol);
  if (s.mode != "cold") name += "/mode:" + s.mode;
  if (s.threads != 1) name += fmt::format("/threads:{}", s.threads);
  if (s.stop != "common") name += "/stop:" + s.stop;
  if (s.timing != "once") name += "/timing:" + s.timing;
  if (record.sequence.length > 1) name += "/" + record.sequence.name;
  if (!in_time(record)) name += fmt::format("/failed:{}", to_string(record.status));
  return name;
}

Json context(const Record& record) {
  return {{"date", record.started_at},
          {"host_name", record.host.cpu},
          {"executable", "conebench " + record.host.version},
          {"num_cpus", record.host.cores},
          {"mhz_per_cpu", 0},
          {"cpu_scaling_enabled", false},
          {"caches", Json::array()},
          {"load_avg", Json::array()},
          {"library_build_type", "release"},
          {"compiler", record.host.compiler},
          {"build", record.host.build}};
}

void add_times(Json& run, const Record& record) {
  run["iterations"] = record.timed_solves;
  run["real_time"] = (record.setup_s + record.solve_s) * kNanosecondsPerSecond;
  run["cpu_time"] = record.solver_cpu_s * kNanosecondsPerSecond;
  run["time_unit"] = "ns";
  run["eta"] = record.eta;
  run["solver_iterations"] = record.iterations;
  run["cones"] = record.problem.cones;
}

void add_error(Json& run, const Record& record) {
  const bool late = record.status == Status::kConverged;
  run["error_occurred"] = true;
  run["error_message"] = late ? "after the time limit" : to_string(record.status);
}

}  // namespace

std::string gbench_report(std::span<const Record> records) {
  Json report = {{"context", records.empty() ? Json::object() : context(records.front())},
                 {"benchmarks", Json::array()},
                 {"failures", Json::array()}};
  const Builds builds(records);
  const auto solver_of = [&](const Record& r) { return contender(builds.name(r), r.donor); };
  std::map<std::string, int> families, instances, repetitions, index_of_run;
  for (const Record& record : records) ++repetitions[run_name(record, solver_of(record))];
  for (const Record& record : records) {
    const std::string solver = solver_of(record), name = run_name(record, solver);
    Json run = {{"name", name}};
    run["family_index"] = families.try_emplace(solver, families.size()).first->second;
    run["per_family_instance_index"] = instances.try_emplace(name, instances.size()).first->second;
    run["run_name"] = name;
    run["run_type"] = "iteration";
    run["repetitions"] = repetitions[name];
    run["repetition_index"] = index_of_run[name]++;
    run["threads"] = record.settings.threads;
    const bool timed = in_time(record);
    timed ? add_times(run, record) : add_error(run, record);
    report[timed ? "benchmarks" : "failures"].push_back(std::move(run));
  }
  return report.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace conebench::results
