#include "results/store_outcomes.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <unordered_map>
#include <unordered_set>

#include "results/profiles.h"
#include "results/shares.h"

namespace conebench::results {
namespace {

// The repetitions of one task.
struct Task {
  std::span<const Run> runs;
  bool compared = false;  // every contender was run on its problem
};

std::vector<Task> tasks_of(std::span<const Run> runs) {
  std::vector<Task> tasks;
  std::unordered_map<std::int64_t, std::size_t> contenders_of_problem;
  std::unordered_set<std::int64_t> contenders;
  for (std::size_t first = 0; first < runs.size();) {
    std::size_t last = first;
    while (last < runs.size() && runs[last].key() == runs[first].key()) ++last;
    tasks.push_back({.runs = runs.subspan(first, last - first)});
    ++contenders_of_problem[runs[first].problem];
    contenders.insert(runs[first].contender);
    first = last;
  }
  for (Task& task : tasks) {
    task.compared = contenders_of_problem[task.runs.front().problem] == contenders.size();
  }
  return tasks;
}

void write_outcome(SQLite::Statement& insert, double tol, const Task& task) {
  std::vector<const Record*> repetitions;
  for (const Run& run : task.runs) repetitions.push_back(run.record);
  const Outcome outcome = outcome_of(repetitions, tol);
  const Run& run = task.runs.front();
  insert.bind(1, run.settings);
  insert.bind(2, tol);
  insert.bind(3, run.contender);
  insert.bind(4, run.problem);
  if (std::isfinite(outcome.time_s)) {
    insert.bind(5, outcome.time_s);
  } else {
    insert.bind(5);
  }
  insert.bind(6, static_cast<int>(outcome.status));
  insert.bind(7, static_cast<int>(task.compared));
  insert.exec();
  insert.reset();
}

// Of one settings, in the order of the table's key, which is the quickest to write.
void write_outcomes(SQLite::Database& database, std::span<const Run> runs) {
  const auto tasks = tasks_of(runs);
  auto tolerances = tolerance_ladder(runs.front().record->settings.tol);
  std::reverse(tolerances.begin(), tolerances.end());
  SQLite::Statement insert(database, "INSERT INTO outcome VALUES (?, ?, ?, ?, ?, ?, ?)");
  for (const double tol : tolerances) {
    for (const Task& task : tasks) write_outcome(insert, tol, task);
  }
}

}  // namespace

void write_all_outcomes(SQLite::Database& database, std::vector<Run> runs) {
  std::stable_sort(runs.begin(), runs.end(),
                   [](const Run& a, const Run& b) { return a.key() < b.key(); });
  for (auto first = runs.begin(); first != runs.end();) {
    const auto last = std::find_if(first, runs.end(),
                                   [&](const Run& run) { return run.settings != first->settings; });
    write_outcomes(database, {first, last});
    first = last;
  }
  database.exec(
      "INSERT INTO solved SELECT settings_id, tol, contender_id, "
      "sum(compared AND time_s IS NOT NULL), sum(compared) FROM outcome "
      "GROUP BY settings_id, tol, contender_id");
}

}  // namespace conebench::results
