#pragma once

#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "results/status.h"

namespace conebench::results {

/// What was solved.
struct ProblemId {
  std::string name{};            ///< e.g. "column-dry_000420"
  std::string content_sha256{};  ///< the same for twins in two formats
  std::string path{};
  std::string family{};  ///< "engine/scene"; what a file does not say is left out
  int cones = 0;
};

/// The rules of a task. Results are compared only where these agree.
struct Settings {
  double tol = 1e-8;  ///< on eta [-]
  double time_limit_s = std::numeric_limits<double>::infinity();
  std::uint64_t memory_limit_bytes = 0;  ///< 0: none
  std::string stop = "common";           ///< "common" or "own": see solvers::StopTest
  std::string mode = "cold";             ///< what a solve starts from: see harness::Mode
  int threads = 1;                       ///< that the solver may use
  std::string timing = "once";           ///< "once", or "repeated": the median of many solves

  bool operator==(const Settings&) const = default;
};

/// The machine and the build that a task ran on.
struct Host {
  std::string cpu;       ///< model name
  int cores = 0;         ///< that this process may use
  std::string compiler;  ///< name and version
  std::string build;     ///< "RelWithDebInfo, for this processor, OpenBLAS for Haswell"
  std::string version;   ///< of conebench

  /// What two hosts must share for their times to be comparable: processor and cores.
  std::string host_class() const;

  bool operator==(const Host&) const = default;
};

/// The place of a record in a sequence of consecutive steps that one task solved.
struct SequencePlace {
  std::string name{};  ///< "scene, steps 3 to 12"; empty: no sequence
  std::string id{};    ///< hash of the contents of its problems, in order
  int index = 0;       ///< of this record, from 0
  int length = 1;      ///< records of the task
};

/// One look at the iterate during a solve.
struct CurvePoint {
  double time_s = 0.0;  ///< solver time, set-up included, residuals excluded
  std::int64_t iteration = 0;
  double eta = 0.0;
};

/// One task: one solver on one problem, once. Residuals are recomputed from r' after the solve by
/// problems::evaluate_residual; the solver's own estimate appears nowhere. A residual that could
/// not be computed is infinite, and `status` says why.
struct Record {
  static constexpr double kUnknown = std::numeric_limits<double>::infinity();

  ProblemId problem;
  std::string solver;           ///< variant identity
  std::string kind = "method";  ///< "method", "model" or "peer"
  std::string solver_build{};   ///< hash of what the solver was built to
  Settings settings;
  int repetition = 0;
  SequencePlace sequence{};
  std::string donor{};  ///< of a sequence: whose answers are the guesses; empty: the solver's own

  Status status = Status::kCrashed;
  std::string claimed;    ///< the solver's own status; empty if it never answered
  double eta = kUnknown;  ///< [-]
  double fclib_residual = kUnknown;
  double siconos_residual = kUnknown;
  double attainable_eta = kUnknown;  ///< what rounding allows: see problems::Residual
  double guess_eta = kUnknown;       ///< of what the solve started from
  /// Of a model: eta of the answer in the model's own problem, where `eta` is the model's gap.
  double model_eta = kUnknown;
  std::int64_t iterations = 0;
  /// Solver time before and in the iterations: the medians of `timed_solves` solves.
  double setup_s = 0.0, solve_s = 0.0;
  std::int64_t timed_solves = 1;
  /// Half width of the 95 % interval of that median, over the median; infinite where unknown.
  double time_spread = kUnknown;
  double solver_cpu_s = 0.0;              ///< processor time of one solve, set-up included
  std::uint64_t allocations = 0;          ///< calls for memory in one solve
  std::uint64_t solver_memory_bytes = 0;  ///< growth of the resident peak in the solves
  double wall_s = 0.0, cpu_s = 0.0;       ///< of the whole worker, loading and judging included
  std::uint64_t peak_memory_bytes = 0;    ///< of the whole worker
  std::vector<CurvePoint> curve;          ///< empty with the solver's own stopping test
  std::vector<std::string> notes;
  std::string error;       ///< a signal, an exception, the tail of stderr
  std::string started_at;  ///< UTC, ISO 8601
  Host host;

  /// True when the *verified* eta meets the tolerance, whatever the solver said.
  bool solved() const { return eta <= settings.tol; }
};

/// Identifies a row of results: a hash of problem content, solver and its build, settings,
/// repetition, host class, and of a sequence its problems, the donor and the place. [32 hex digits]
std::string task_key(const Record& record);

/// The same for all records of one sequence that one task solved; task_key() of any other record.
std::string sequence_key(const Record& record);

/// The first 32 hex digits of the SHA-256 of `text`.
std::string short_hash(std::string_view text);

/// One flat object. JSON has no infinity: non-finite numbers become null, and null reads back as
/// infinity.
nlohmann::json to_json(const Record& record);

/// Throws problems::InputError naming `where` when a member is missing or of the wrong type.
Record record_from_json(const nlohmann::json& json, const std::string& where);

nlohmann::json to_json(const Host& host);

}  // namespace conebench::results
