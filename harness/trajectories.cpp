#include "harness/trajectories.h"

#include <chrono>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "harness/host.h"
#include "harness/interrupt.h"
#include "harness/progress.h"
#include "problems/error.h"
#include "results/line_file.h"

namespace conebench::harness {
namespace {

using nlohmann::json;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

// JSON has no NaN.
json to_json(const TrajectoryRow& row) {
  json values;
  for (const ObservableKind& kind : observables()) {
    const double value = row.observed[static_cast<std::size_t>(kind.what)];
    values[std::string(kind.key)] = std::isfinite(value) ? json(value) : json();
  }
  return {{"key", row.key},
          {"solver", row.solver},
          {"tol", row.tol},
          {"seed", row.seed},
          {"steps", row.steps},
          {"observed", values},
          {"reference", row.reference},
          {"wall_s", row.wall_s},
          {"error", row.error},
          {"started_at", row.started_at}};
}

TrajectoryRow row_from(const json& in) {
  TrajectoryRow row;
  in.at("key").get_to(row.key);
  in.at("solver").get_to(row.solver);
  in.at("tol").get_to(row.tol);
  in.at("seed").get_to(row.seed);
  in.at("steps").get_to(row.steps);
  in.at("reference").get_to(row.reference);
  in.at("wall_s").get_to(row.wall_s);
  in.at("error").get_to(row.error);
  in.at("started_at").get_to(row.started_at);
  for (const ObservableKind& kind : observables()) {
    const json& value = in.at("observed").at(std::string(kind.key));
    row.observed[static_cast<std::size_t>(kind.what)] =
        value.is_null() ? kNone : value.get<double>();
  }
  return row;
}

std::map<std::string, TrajectoryRow> read_rows(const std::filesystem::path& path) {
  std::map<std::string, TrajectoryRow> rows;
  std::ifstream file(path);
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    const json in = json::parse(line, nullptr, false);
    if (in.is_discarded()) continue;  // cut short by a kill
    try {
      TrajectoryRow row = row_from(in);
      rows[row.key] = std::move(row);
    } catch (const json::exception& error) {
      throw problems::InputError(path.string() + ", line " + std::to_string(number), error.what());
    }
  }
  return rows;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

std::optional<TrajectoryRow> run_trajectory(const TrajectoryTask& task,
                                            const std::function<void()>& tick) {
  TrajectoryRow row{.key = task.key,
                    .solver = task.solver,
                    .tol = task.tol,
                    .seed = task.seed,
                    .reference = task.reference,
                    .started_at = utc_now()};
  row.observed.fill(kNone);
  const auto start = std::chrono::steady_clock::now();
  const std::unique_ptr<Engine> engine = make_engine(task.scene, {.solver = task.solver});
  const Watch watch(*engine);
  try {
    while (task.steps > 0 ? engine->steps() < task.steps : !engine->finished()) {
      engine->step();
      tick();
      if (interrupted()) return std::nullopt;
    }
    row.observed = watch.observed();
  } catch (const std::runtime_error& error) {
    row.error = error.what();
  }
  row.steps = engine->steps();
  row.wall_s = seconds_since(start);
  return row;
}

TrajectoryRows run_trajectories(const TrajectoryPlan& plan, const std::filesystem::path& folder) {
  std::optional<results::LineFile> file;
  std::map<std::string, TrajectoryRow> known;
  if (!folder.empty()) {
    file.emplace(folder / "runs.jsonl");
    known = read_rows(folder / "runs.jsonl");
  }
  TrajectoryRows out;
  Progress progress("runs", plan.tasks.size());
  for (const TrajectoryTask& task : plan.tasks) {
    const auto found = known.find(task.key);
    std::optional<TrajectoryRow> row;
    if (found != known.end()) {
      row = found->second;
      ++out.earlier;
    } else {
      row = run_trajectory(task, [&] { progress.show(); });
      if (!row) {
        out.interrupted = true;
        return out;
      }
      if (file) file->append(to_json(*row).dump() + "\n");
    }
    progress.finished_one(row->error.empty());
    progress.show();
    out.rows.push_back(std::move(*row));
  }
  return out;
}

}  // namespace conebench::harness
