#include "results/store.h"

#include <algorithm>
#include <unordered_map>

#include "problems/error.h"
#include "results/store_connection.h"

namespace conebench::results {

using problems::InputError;
using problems::require;

Store::Store(const std::filesystem::path& path) {
  require(std::filesystem::is_regular_file(path), path.string(), "is no file, expected a store");
  try {
    connection_ = std::make_unique<Connection>(path);
    const auto pragma = [&](const char* name) {
      return connection_->database.execAndGet(std::string("PRAGMA ") + name).getInt();
    };
    require(pragma("application_id") == kStoreId, path.string(),
            "is a database of another program, expected a store");
    const int version = pragma("user_version");
    require(version == kStoreVersion, path.string(), "is a store of version ", version,
            ", expected ", kStoreVersion, ": make it anew from the journals");
    const auto size = static_cast<std::uintmax_t>(pragma("page_count")) *
                      static_cast<std::uintmax_t>(pragma("page_size"));
    require(std::filesystem::file_size(path) == size, path.string(), "has ",
            std::filesystem::file_size(path), " bytes, expected ", size, ": it is truncated");
  } catch (const SQLite::Exception& error) {
    throw InputError(path.string(), std::string(error.what()) + ", expected a store");
  }
}

Store::~Store() = default;
Store::Store(Store&&) noexcept = default;

std::vector<Settings> Store::settings() const {
  return connection_->ask([&] {
    std::vector<Settings> found;
    for (const auto& [settings, id] : connection_->settings()) found.push_back(settings);
    return found;
  });
}

std::vector<double> Store::tolerances(const Settings& settings) const {
  return connection_->ask([&] { return connection_->tolerances(connection_->id_of(settings)); });
}

TimeTable Store::times(const Settings& settings, double tol) const {
  return connection_->ask([&] {
    const std::int64_t id = connection_->id_of(settings);
    const auto contenders = connection_->contenders(id);
    const auto problems = connection_->problems();
    TimeTable table{.tol = tol, .solvers = {}, .rows = {}};
    for (const auto& contender : contenders) table.solvers.push_back(contender.first);
    std::unordered_map<std::int64_t, std::size_t> row_of_problem;
    connection_->for_each_outcome(id, tol, contenders, [&](std::size_t s, SQLite::Statement& row) {
      const std::int64_t problem = row.getColumn(0).getInt64();
      const auto [found, is_new] = row_of_problem.try_emplace(problem, table.rows.size());
      if (is_new) {
        table.rows.push_back({.problem = problems.at(problem),
                              .time_s = std::vector<double>(contenders.size(), Record::kUnknown),
                              .status = std::vector<std::optional<Status>>(contenders.size())});
      }
      table.rows[found->second].time_s[s] = number(row.getColumn(1));
      table.rows[found->second].status[s] = static_cast<Status>(row.getColumn(2).getInt());
    });
    std::sort(table.rows.begin(), table.rows.end(), before);
    return table;
  });
}

SolvedCounts Store::solved(const Settings& settings) const {
  return connection_->ask([&] {
    const std::int64_t id = connection_->id_of(settings);
    SolvedCounts counts{.tolerances = connection_->tolerances(id), .solvers = {}, .solved = {}};
    SQLite::Statement row(connection_->database,
                          "SELECT solved, problems FROM solved WHERE settings_id = ? AND "
                          "contender_id = ? ORDER BY tol DESC");
    for (const auto& [name, contender] : connection_->contenders(id)) {
      row.reset();
      row.bind(1, id);
      row.bind(2, contender);
      counts.solvers.push_back(name);
      counts.solved.emplace_back();
      while (row.executeStep()) {
        counts.solved.back().push_back(row.getColumn(0).getInt());
        counts.problems = row.getColumn(1).getInt();
      }
    }
    return counts;
  });
}

std::map<std::string, Tails> Store::tails_of_times(const Settings& settings, double tol) const {
  return connection_->ask([&] {
    const std::int64_t id = connection_->id_of(settings);
    const auto contenders = connection_->contenders(id);
    std::vector<std::vector<double>> times_s(contenders.size());
    connection_->for_each_outcome(id, tol, contenders, [&](std::size_t s, SQLite::Statement& row) {
      if (row.getColumn(3).getInt() == 1) times_s[s].push_back(number(row.getColumn(1)));
    });
    std::map<std::string, Tails> found;
    for (std::size_t s = 0; s < contenders.size(); ++s) {
      if (const auto of_times = tails(times_s[s])) found[contenders[s].first] = *of_times;
    }
    return found;
  });
}

std::map<std::string, std::map<Status, int>> Store::statuses(const Settings& settings) const {
  return connection_->ask([&] {
    SQLite::Statement row(
        connection_->database,
        "SELECT solver, status_id, sum(tasks) FROM (SELECT solver_id, status_id, count(*) AS tasks "
        "FROM task WHERE settings_id = ? GROUP BY solver_id, status_id) JOIN solver ON "
        "solver.id = solver_id GROUP BY solver, status_id");
    row.bind(1, connection_->id_of(settings));
    std::map<std::string, std::map<Status, int>> found;
    while (row.executeStep()) {
      const auto status = static_cast<Status>(row.getColumn(1).getInt());
      found[row.getColumn(0).getString()][status] = row.getColumn(2).getInt();
    }
    return found;
  });
}

std::vector<Record> Store::records_of_problem(const std::string& content_sha256) const {
  if (content_sha256.empty()) return {};
  return connection_->ask([&] { return connection_->records(content_sha256); });
}

std::vector<Record> Store::records() const {
  return connection_->ask([&] { return connection_->records(); });
}

}  // namespace conebench::results
