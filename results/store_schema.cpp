#include "results/store_schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace conebench::results {
namespace {

std::string_view type_of(Kind kind) {
  switch (kind) {
    case Kind::kInteger:
      return "INTEGER";
    case Kind::kReal:
      return "REAL";
    case Kind::kText:
    case Kind::kJson:
      return "TEXT";
  }
  return "";
}

std::string definitions(std::string_view table) {
  std::string sql;
  for (const Column& column : columns_of(table)) {
    sql += fmt::format(", {} {}", column.name, type_of(column.kind));
  }
  return sql;
}

std::string view_sql() {
  std::string names;
  for (const Column& column : kColumns) names += fmt::format("{}.{}, ", column.table, column.name);
  std::string sql = fmt::format(
      "CREATE VIEW record AS SELECT task.id AS id, {}status.status FROM task "
      "JOIN status ON status.id = status_id LEFT JOIN curve ON task_id = task.id",
      names);
  for (const auto table : kDimensions) sql += fmt::format(" JOIN {0} ON {0}.id = {0}_id", table);
  return sql + ";\n";
}

}  // namespace

std::vector<Column> columns_of(std::string_view table) {
  std::vector<Column> columns;
  std::copy_if(std::begin(kColumns), std::end(kColumns), std::back_inserter(columns),
               [&](const Column& column) { return column.table == table; });
  return columns;
}

std::string tables_sql() {
  std::string sql, references;
  for (const auto table : kDimensions) {
    sql += fmt::format("CREATE TABLE {} (id INTEGER PRIMARY KEY{});\n", table, definitions(table));
    references += fmt::format(", {0}_id INTEGER NOT NULL REFERENCES {0}", table);
  }
  sql += "CREATE TABLE status (id INTEGER PRIMARY KEY, status TEXT NOT NULL);\n";
  sql += fmt::format(
      "CREATE TABLE task (id INTEGER PRIMARY KEY{}, "
      "status_id INTEGER NOT NULL REFERENCES status{});\n",
      references, definitions("task"));
  sql += fmt::format("CREATE TABLE curve (task_id INTEGER PRIMARY KEY REFERENCES task{});\n",
                     definitions("curve"));
  sql +=
      "CREATE TABLE contender (id INTEGER PRIMARY KEY, contender TEXT NOT NULL);\n"
      "CREATE TABLE outcome (settings_id INTEGER NOT NULL REFERENCES settings, tol REAL NOT NULL, "
      "contender_id INTEGER NOT NULL REFERENCES contender, problem_id INTEGER NOT NULL REFERENCES "
      "problem, time_s REAL, status_id INTEGER NOT NULL REFERENCES status, compared INTEGER NOT "
      "NULL, PRIMARY KEY (settings_id, tol, contender_id, problem_id)) WITHOUT ROWID;\n"
      "CREATE TABLE solved (settings_id INTEGER NOT NULL REFERENCES settings, tol REAL NOT NULL, "
      "contender_id INTEGER NOT NULL REFERENCES contender, solved INTEGER NOT NULL, problems "
      "INTEGER NOT NULL, PRIMARY KEY (settings_id, tol, contender_id)) WITHOUT ROWID;\n";
  return sql + view_sql();
}

std::string indexes_sql() {
  return "CREATE UNIQUE INDEX task_by_key ON task (task_key);\n"
         "CREATE INDEX task_by_problem ON task (problem_id);\n"
         "CREATE INDEX task_by_status ON task (settings_id, solver_id, status_id);\n"
         "CREATE INDEX problem_by_content ON problem (content_sha256);\n";
}

}  // namespace conebench::results
