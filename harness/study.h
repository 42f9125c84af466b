#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "harness/mode.h"
#include "harness/problem_id.h"
#include "harness/worker.h"
#include "solvers/solver.h"

namespace conebench::harness {

/// What a campaign shall compare, as a study file or the command line says it: every solver on
/// every problem at every tolerance, in every mode, with every number of threads.
///
///   schema = 1
///   problems = ["collection", "more/one.h5"]    # files or folders, relative to the study file
///   where = 'cones > 100 && engine == "mpm"'    # optional; see harness/where.h
///   solvers = ["auto", "gs[omega=0.8,1]"]       # lists make grids
///   tol = [1e-4, 1e-8]
///   mode = ["cold", "sequence"]
///   donors = ["own", "gs"]                      # of mode sequence: whose answers are the guesses
///   threads = [1]
///   time_limit = "10s"
///   hard_limit = "60s"                          # optional
///   memory = "2G"
///   stop = "common"
///   repetitions = 3                             # or "auto": many solves of a short task in one
///   seed = 1                                    # of the order of the tasks
struct Study {
  std::vector<std::string> problems{};
  std::string where{};
  std::vector<std::string> solvers{};
  std::vector<double> tolerances = {1e-8};
  std::vector<std::string> modes = {"cold"};
  std::vector<std::string> donors = {"own"};
  std::vector<int> threads = {1};
  std::string time_limit = "10s";
  std::string hard_limit{};
  std::string memory = "2G";
  std::string stop = "common";
  std::string repetitions = "1";  ///< a number or "auto"
  std::uint64_t seed = 1;
};

/// Throws problems::InputError naming file, line and key.
Study read_study(const std::filesystem::path& path);

/// The donor that is the solver itself.
inline constexpr const char* kOwn = "own";

/// A study, checked and made: what a campaign runs.
struct Plan {
  std::vector<solvers::Stop> stops;  ///< one a tolerance
  std::vector<Shared<solvers::Solver>> solvers;
  std::vector<Mode> modes;
  std::vector<std::optional<Shared<solvers::Solver>>> donors;
  std::vector<int> threads;
  std::uint64_t memory_limit_bytes = 0;
  std::optional<double> hard_limit_s{};
  int repetitions = 1;
  bool repeat_for_confidence = false;
  std::uint64_t seed = 1;
};

/// Throws problems::InputError naming the key.
Plan check(const Study& study);

}  // namespace conebench::harness
