// How long the report's questions take a store of many rows.
//
//   store_benchmark ROWS FILE     e.g. store_benchmark 1000000 /tmp/store.db
//
// Writes FILE from made-up records (20 solvers, the same settings, 100 steps a scene, a tenth
// failures, curves of 8 points) and prints a line a question: the time of the first answer and of
// the fastest of three.

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "results/store.h"

namespace {

using namespace conebench::results;

constexpr std::size_t kSolvers = 20, kStepsOfScene = 100, kCurvePoints = 8;
constexpr std::size_t kFailureEvery = 10;

Record made_up(std::size_t row) {
  const std::size_t solver = row % kSolvers, problem = row / kSolvers;
  Record record;
  record.problem = {.name = fmt::format("scene-{}_{:06}", problem / kStepsOfScene, problem),
                    .content_sha256 = fmt::format("{:064x}", problem),
                    .path = fmt::format("problems/{}.h5", problem),
                    .family = fmt::format("dem/scene-{}", problem / kStepsOfScene),
                    .cones = static_cast<int>(100 + problem % 1000)};
  record.solver = fmt::format("solver-{}", solver);
  record.settings.tol = 1e-8;
  record.settings.time_limit_s = 10.0;
  const bool failed = (row * 2654435761u) % 100 < 100 / kFailureEvery;
  record.status = failed ? Status::kTimeLimit : Status::kConverged;
  record.eta = failed ? 1e-3 : 0.5 * record.settings.tol;
  record.solve_s = 1e-3 * static_cast<double>(1 + (row * 40503) % 997);
  record.iterations = 100;
  for (std::size_t i = 1; i <= kCurvePoints; ++i) {
    const double share = static_cast<double>(i) / kCurvePoints;
    record.curve.push_back({record.solve_s * share, static_cast<std::int64_t>(100 * share),
                            std::pow(record.eta, share)});
  }
  record.started_at = "2024-05-01T12:00:00Z";
  record.host = {.cpu = "a processor", .cores = 2, .compiler = "g++", .build = "", .version = "1"};
  return record;
}

double seconds_of(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void time_question(const char* name, const std::function<void()>& question) {
  const double first_s = seconds_of(question);
  double best_s = first_s;
  for (int again = 0; again < 2; ++again) best_s = std::min(best_s, seconds_of(question));
  fmt::print("{:<36} first {:8.3f} s   fastest of three {:8.3f} s\n", name, first_s, best_s);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    fmt::print(stderr, "usage: store_benchmark ROWS FILE\n");
    return 2;
  }
  const std::filesystem::path path = argv[2];
  {
    std::vector<Record> records;
    const auto rows = static_cast<std::size_t>(std::strtoull(argv[1], nullptr, 10));
    for (std::size_t row = 0; row < rows; ++row) records.push_back(made_up(row));
    fmt::print("{} rows written in {:.1f} s\n", rows,
               seconds_of([&] { write_store(path, records); }));
  }
  fmt::print("{} bytes\n", std::filesystem::file_size(path));
  time_question("open", [&] { Store store(path); });
  const Store store(path);
  const Settings settings = store.settings().front();
  time_question("times to 1e-8", [&] { store.times(settings, 1e-8); });
  time_question("times to 1e-8, ranked", [&] { rank(store.times(settings, 1e-8)); });
  time_question("share solved against tolerance", [&] { store.solved(settings); });
  time_question("tails of every solver", [&] { store.tails_of_times(settings, 1e-8); });
  time_question("failures by status", [&] { store.statuses(settings); });
  time_question("rows of one problem",
                [&] { store.records_of_problem(fmt::format("{:064x}", 7)); });
}
