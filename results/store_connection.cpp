#include "results/store_connection.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "results/store_schema.h"

namespace conebench::results {
namespace {

using nlohmann::json;

json value_of(const SQLite::Column& column, Kind kind) {
  if (column.isNull()) return nullptr;
  switch (kind) {
    case Kind::kText:
      return column.getString();
    case Kind::kInteger:
      return column.getInt64();
    case Kind::kReal:
      return column.getDouble();
    case Kind::kJson:
      return json::parse(column.getString());
  }
  return nullptr;
}

Record record_of(SQLite::Statement& row, const std::string& path) {
  json members;
  int place = 0;
  for (const Column& column : kColumns) {
    members[column.name] = value_of(row.getColumn(place++), column.kind);
  }
  if (members["curve"].is_null()) members["curve"] = json::array();
  members["status"] = row.getColumn(place).getString();
  return record_from_json(members, path);
}

// The columns that record_of() reads.
std::string select_records() {
  std::string names;
  for (const Column& column : kColumns) names += fmt::format("{}, ", column.name);
  return "SELECT " + names + "status FROM record ";
}

}  // namespace

double number(const SQLite::Column& column) {
  return column.isNull() ? std::numeric_limits<double>::infinity() : column.getDouble();
}

Store::Connection::Connection(const std::filesystem::path& file)
    : path(file.string()), database(path, SQLite::OPEN_READONLY) {}

std::vector<std::pair<Settings, std::int64_t>> Store::Connection::settings() {
  SQLite::Statement row(database,
                        "SELECT id, tol, time_limit_s, memory_limit_bytes, stop, mode, threads, "
                        "timing FROM settings ORDER BY id");
  std::vector<std::pair<Settings, std::int64_t>> found;
  while (row.executeStep()) {
    const Settings settings = {
        .tol = row.getColumn(1).getDouble(),
        .time_limit_s = number(row.getColumn(2)),
        .memory_limit_bytes = static_cast<std::uint64_t>(row.getColumn(3).getInt64()),
        .stop = row.getColumn(4).getString(),
        .mode = row.getColumn(5).getString(),
        .threads = row.getColumn(6).getInt(),
        .timing = row.getColumn(7).getString()};
    found.emplace_back(settings, row.getColumn(0).getInt64());
  }
  return found;
}

std::int64_t Store::Connection::id_of(const Settings& wanted) {
  for (const auto& [known, id] : settings()) {
    if (known == wanted) return id;
  }
  throw problems::InputError(path, "holds no results with these settings");
}

std::vector<double> Store::Connection::tolerances(std::int64_t settings) {
  SQLite::Statement row(database,
                        "SELECT DISTINCT tol FROM solved WHERE settings_id = ? ORDER BY tol DESC");
  row.bind(1, settings);
  std::vector<double> found;
  while (row.executeStep()) found.push_back(row.getColumn(0).getDouble());
  return found;
}

void Store::Connection::check_tolerance(std::int64_t settings, double tol) {
  const auto known = tolerances(settings);
  problems::require(
      std::find(known.begin(), known.end(), tol) != known.end(), path,
      fmt::format("has no times to {}, expected one of {}", tol, fmt::join(known, ", ")));
}

std::vector<Store::Connection::Contender> Store::Connection::contenders(std::int64_t settings) {
  SQLite::Statement row(database,
                        "SELECT DISTINCT contender, contender_id FROM solved JOIN contender ON "
                        "id = contender_id WHERE settings_id = ? ORDER BY contender");
  row.bind(1, settings);
  std::vector<Contender> found;
  while (row.executeStep()) {
    found.emplace_back(row.getColumn(0).getString(), row.getColumn(1).getInt64());
  }
  return found;
}

std::unordered_map<std::int64_t, ProblemId> Store::Connection::problems() {
  SQLite::Statement row(database,
                        "SELECT id, problem, content_sha256, path, family, cones FROM problem");
  std::unordered_map<std::int64_t, ProblemId> found;
  while (row.executeStep()) {
    found[row.getColumn(0).getInt64()] = {
        row.getColumn(1).getString(), row.getColumn(2).getString(), row.getColumn(3).getString(),
        row.getColumn(4).getString(), row.getColumn(5).getInt()};
  }
  return found;
}

std::vector<Record> Store::Connection::records(const std::string& content_sha256) {
  std::string question = select_records();
  if (!content_sha256.empty()) {
    question +=
        "WHERE id IN (SELECT task.id FROM problem JOIN task ON problem.id = problem_id WHERE "
        "content_sha256 = ?) ";
  }
  SQLite::Statement row(database, question + "ORDER BY id");
  if (!content_sha256.empty()) row.bind(1, content_sha256);
  std::vector<Record> found;
  while (row.executeStep()) found.push_back(record_of(row, path));
  return found;
}

}  // namespace conebench::results
