#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "problems/problem.h"

namespace conebench::solvers {

/// Why a solver stopped. Whatever the status, Result::r holds the best iterate it knows.
enum class Status {
  kConverged,       ///< the stopping test met the tolerance
  kIterationLimit,  ///< Stop::max_iterations was used up
  kTimeLimit,       ///< Stop::time_limit_s was used up
  kStalled,         ///< the iterate stopped moving before the test met the tolerance
  kDiverged,        ///< a NaN or an infinity appeared
  kInfeasible,      ///< proved to have no solution; Result::certificate is the proof
  kUnsupported,     ///< not a problem for this solver; see Result::notes
};

/// "converged", "iteration_limit", ...: the names used in files and on the command line.
std::string_view to_string(Status status);

/// Who decides that an answer is good enough.
enum class StopTest {
  kCommon,  ///< eta, computed by the Monitor outside the clock: the same test for every method
  kOwn,     ///< the method's own test, inside the clock, verified afterwards
};

/// When to stop; the same rule for every solver, so that runs can be compared.
struct Stop {
  double tol = 1e-8;                        ///< on eta (or the own test) [-], > 0
  std::int64_t max_iterations = 1'000'000;  ///< of the solver's outermost loop, >= 0
  double time_limit_s = std::numeric_limits<double>::infinity();  ///< of solver time, > 0
  StopTest test = StopTest::kCommon;
  /// kCommon looks at eta whenever iterations or work have grown by this share, > 0. [-]
  double look_growth = 0.02;

  void check() const;  ///< throws InputError
};

class Monitor;

struct Request {
  Stop stop{};
  Eigen::VectorXd guess{};     ///< r', rows() entries, or empty for 0 [force_unit]
  Monitor* monitor = nullptr;  ///< made for the same problem and stop; null: one is made inside
};

struct Result {
  Status status = Status::kUnsupported;
  Eigen::VectorXd r;               ///< r' of the standard problem, rows() entries [force_unit]
  std::int64_t iterations = 0;     ///< done, of the solver's outermost loop
  Eigen::VectorXd certificate;     ///< kInfeasible: y, rows() entries (solvers/certificate.h)
  double setup_s = 0.0;            ///< clock time before the first iteration
  double solve_s = 0.0;            ///< clock time of the iterations; setup_s not included
  std::vector<std::string> notes;  ///< what a reader of the table should know
};

enum class Kind {
  kMethod,  ///< solves the problem as posed
  kModel,   ///< solves an approximation of it; ranked in a table of its own
  kPeer,    ///< another program
};

std::string_view to_string(Kind kind);

using Value = std::variant<bool, std::int64_t, double, std::string>;

/// One parameter of a solver: its type is that of `fallback`.
struct Parameter {
  std::string name;
  Value fallback;                                         ///< the default
  double low = -std::numeric_limits<double>::infinity();  ///< of numbers, inclusive
  double high = std::numeric_limits<double>::infinity();
  std::vector<std::string> choices{};  ///< of a string; empty: any text
  std::string doc{};                   ///< one sentence, with the unit
};

/// A solver with its parameters set: a name, what it can solve, and a pure function.
struct Solver {
  std::string name;  ///< variant identity, e.g. "gs[local=projection]"; defaults omitted
  Kind kind = Kind::kMethod;
  std::vector<Parameter> parameters;  ///< the schema of its method
  /// Why it cannot take this (standard) problem, or nothing if it can.
  std::function<std::optional<std::string>(const problems::Problem&)> refuses;
  /// Precondition: `standard` has kappa = 0. Throws InputError for a bad request only.
  std::function<Result(const problems::Problem& standard, const Request&)> solve;
  /// The file of a solver from outside this program (`exec:`, `plugin:`), absolute; empty: ours.
  std::filesystem::path program{};

  bool supports(const problems::Problem& standard) const { return !refuses(standard); }
};

}  // namespace conebench::solvers
