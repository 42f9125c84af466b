#pragma once

// Internal to the store: how a record is spread over tables. See results/store.h.

#include <string>
#include <string_view>
#include <vector>

namespace conebench::results {

enum class Kind { kText, kInteger, kReal, kJson };

struct Column {
  std::string_view name;  ///< of the member in to_json(Record)
  std::string_view table;
  Kind kind;
};

/// Every member of to_json(Record) but its status, which is a reference, and the task_key().
inline constexpr Column kColumns[] = {
    {"problem", "problem", Kind::kText},
    {"content_sha256", "problem", Kind::kText},
    {"path", "problem", Kind::kText},
    {"family", "problem", Kind::kText},
    {"cones", "problem", Kind::kInteger},
    {"solver", "solver", Kind::kText},
    {"kind", "solver", Kind::kText},
    {"solver_build", "solver", Kind::kText},
    {"tol", "settings", Kind::kReal},
    {"time_limit_s", "settings", Kind::kReal},
    {"memory_limit_bytes", "settings", Kind::kInteger},
    {"stop", "settings", Kind::kText},
    {"mode", "settings", Kind::kText},
    {"threads", "settings", Kind::kInteger},
    {"timing", "settings", Kind::kText},
    {"host", "host", Kind::kJson},
    {"task_key", "task", Kind::kText},
    {"repetition", "task", Kind::kInteger},
    {"sequence", "task", Kind::kJson},
    {"donor", "task", Kind::kText},
    {"claimed", "task", Kind::kText},
    {"eta", "task", Kind::kReal},
    {"fclib_residual", "task", Kind::kReal},
    {"siconos_residual", "task", Kind::kReal},
    {"attainable_eta", "task", Kind::kReal},
    {"guess_eta", "task", Kind::kReal},
    {"model_eta", "task", Kind::kReal},
    {"iterations", "task", Kind::kInteger},
    {"setup_s", "task", Kind::kReal},
    {"solve_s", "task", Kind::kReal},
    {"timed_solves", "task", Kind::kInteger},
    {"time_spread", "task", Kind::kReal},
    {"solver_cpu_s", "task", Kind::kReal},
    {"allocations", "task", Kind::kInteger},
    {"solver_memory_bytes", "task", Kind::kInteger},
    {"wall_s", "task", Kind::kReal},
    {"cpu_s", "task", Kind::kReal},
    {"peak_memory_bytes", "task", Kind::kInteger},
    {"curve", "curve", Kind::kJson},
    {"notes", "task", Kind::kJson},
    {"error", "task", Kind::kText},
    {"started_at", "task", Kind::kText},
};

/// The tables that a task refers to by id.
inline constexpr std::string_view kDimensions[] = {"problem", "solver", "settings", "host"};

/// The columns of one table, in the order above.
std::vector<Column> columns_of(std::string_view table);

/// Statements that make the tables and the view, and those that make the indexes once they are
/// full.
std::string tables_sql();
std::string indexes_sql();

}  // namespace conebench::results
