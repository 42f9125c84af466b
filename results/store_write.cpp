#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <nlohmann/json.hpp>
#include <system_error>
#include <unordered_map>
#include <unordered_set>

#include "problems/error.h"
#include "results/builds.h"
#include "results/one_host.h"
#include "results/output.h"
#include "results/store.h"
#include "results/store_outcomes.h"
#include "results/store_schema.h"

namespace conebench::results {
namespace {

using nlohmann::json;
using problems::OutputError;

using Ids = std::vector<std::int64_t>;

// A name may hold bytes that are no UTF-8; they must not cost the store its rows.
std::string dumped(const json& value) {
  return value.dump(-1, ' ', false, json::error_handler_t::replace);
}

void bind(SQLite::Statement& statement, int place, const json& value, Kind kind) {
  if (value.is_null()) {
    statement.bind(place);
  } else if (kind == Kind::kText) {
    statement.bind(place, value.get_ref<const std::string&>());
  } else if (kind == Kind::kInteger) {
    statement.bind(place, value.get<std::int64_t>());
  } else if (kind == Kind::kReal) {
    statement.bind(place, value.get<double>());
  } else {
    statement.bind(place, dumped(value));
  }
}

// Rows of one table: some ids, then the members of a record that the table holds.
class Insert {
 public:
  Insert(SQLite::Database& database, std::string_view table, const std::string& id_names)
      : columns_(columns_of(table)), statement_(database, sql(table, id_names, columns_)) {}

  void run(const Ids& ids, const json& record) {
    int place = 0;
    for (const std::int64_t id : ids) statement_.bind(++place, id);
    for (const Column& column : columns_) {
      bind(statement_, ++place, record.at(column.name), column.kind);
    }
    statement_.exec();
    statement_.reset();
  }
  const std::vector<Column>& columns() const { return columns_; }

 private:
  static std::string sql(std::string_view table, const std::string& id_names,
                         const std::vector<Column>& columns) {
    std::string names = id_names;
    for (const Column& column : columns) names += fmt::format(", {}", column.name);
    std::string places = "?";
    for (const char c : names) places += c == ',' ? ", ?" : "";
    return fmt::format("INSERT INTO {} ({}) VALUES ({})", table, names, places);
  }

  std::vector<Column> columns_;
  SQLite::Statement statement_;
};

// A table whose rows are written once, however many tasks share them.
class Dimension {
 public:
  Dimension(SQLite::Database& database, std::string_view table) : insert_(database, table, "id") {}

  std::int64_t id_of(const json& record) {
    json key = json::array();
    for (const Column& column : insert_.columns()) key.push_back(record.at(column.name));
    const auto next = static_cast<std::int64_t>(ids_.size()) + 1;
    const auto [found, is_new] = ids_.try_emplace(dumped(key), next);
    if (is_new) insert_.run({next}, record);
    return found->second;
  }

 private:
  Insert insert_;
  std::unordered_map<std::string, std::int64_t> ids_;
};

void write_names(SQLite::Database& database, const std::string& table,
                 const std::vector<std::pair<std::int64_t, std::string>>& names) {
  SQLite::Statement insert(database, "INSERT INTO " + table + " VALUES (?, ?)");
  for (const auto& [id, name] : names) {
    insert.bind(1, id);
    insert.bind(2, name);
    insert.exec();
    insert.reset();
  }
}

// Tasks, their curves and what they refer to. Returns the runs of methods and peers.
std::vector<Run> write_tasks(SQLite::Database& database, std::span<const Record> records) {
  std::vector<Dimension> dimensions;
  std::string id_names = "id";
  for (const auto table : kDimensions) {
    dimensions.emplace_back(database, table);
    id_names += fmt::format(", {}_id", table);
  }
  Insert task(database, "task", id_names + ", status_id"), curve(database, "curve", "task_id");

  const OneHost hosts(records);
  const Builds builds(records, hosts);
  std::vector<Run> runs;
  std::unordered_map<std::string, std::int64_t> problem_of_content, contenders;
  std::unordered_set<std::string> keys;
  for (const Record& record : records) {
    json members = to_json(record);
    members["task_key"] = task_key(record);
    problems::require(keys.insert(members["task_key"]).second, record.problem.name,
                      "there are two records of one task: ", record.solver, ", repetition ",
                      record.repetition);
    Ids ids = {static_cast<std::int64_t>(keys.size())};
    for (Dimension& dimension : dimensions) ids.push_back(dimension.id_of(members));
    ids.push_back(static_cast<int>(record.status));
    task.run(ids, members);
    if (!record.curve.empty()) curve.run({ids[0]}, members);

    const std::int64_t problem =
        problem_of_content.try_emplace(record.problem.content_sha256, ids[1]).first->second;
    if (record.kind == "model" || !hosts.counts(record)) continue;
    const auto next = static_cast<std::int64_t>(contenders.size()) + 1;
    const std::string name = contender(builds.name(record), record.donor);
    const auto contender_id = contenders.try_emplace(name, next).first->second;
    runs.push_back(
        {.settings = ids[3], .contender = contender_id, .problem = problem, .record = &record});
  }
  std::vector<std::pair<std::int64_t, std::string>> names;
  for (const auto& [name, id] : contenders) names.emplace_back(id, name);
  write_names(database, "contender", names);
  return runs;
}

void write_all(SQLite::Database& database, std::span<const Record> records) {
  // What makes the write safe is that the file is renamed only when it is complete and synced.
  database.exec("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF");
  database.exec(
      fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", kStoreId, kStoreVersion));
  SQLite::Transaction transaction(database);
  database.exec(tables_sql());
  std::vector<std::pair<std::int64_t, std::string>> statuses;
  for (const Status status : all_statuses()) {
    statuses.emplace_back(static_cast<int>(status), to_string(status));
  }
  write_names(database, "status", statuses);
  write_all_outcomes(database, write_tasks(database, records));
  database.exec(indexes_sql());
  transaction.commit();
  database.exec("ANALYZE");
}

// The new store under a name of its own, which goes away again unless it is published.
class Temporary {
 public:
  explicit Temporary(const std::filesystem::path& target) : target_(target), path_(target) {
    path_.replace_filename(fmt::format(".{}.tmp-{}", target.filename().string(), ::getpid()));
    std::filesystem::remove(path_);
  }
  ~Temporary() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  std::string path() const { return path_.string(); }

  void publish() const {
    sync(path_, O_RDWR);
    std::filesystem::rename(path_, target_);
    sync(target_.has_parent_path() ? target_.parent_path() : ".", O_RDONLY | O_DIRECTORY);
  }

 private:
  void sync(const std::filesystem::path& path, int flags) const {
    const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
    const bool ok = descriptor >= 0 && ::fsync(descriptor) == 0;
    const int reason = errno;
    if (descriptor >= 0) ::close(descriptor);
    if (!ok) throw OutputError(target_.string(), std::generic_category().message(reason));
  }

  std::filesystem::path target_, path_;
};

}  // namespace

void write_store(const std::filesystem::path& path, std::span<const Record> records) {
  if (path.has_parent_path()) make_folder(path.parent_path());
  try {
    const Temporary file(path);
    {
      SQLite::Database database(file.path(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
      write_all(database, records);
    }
    file.publish();
  } catch (const SQLite::Exception& error) {
    throw OutputError(path.string(), error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    throw OutputError(path.string(), error.code().message());
  }
}

}  // namespace conebench::results
