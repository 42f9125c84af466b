#pragma once

#include <functional>
#include <string>
#include <vector>

#include "harness/worker.h"
#include "problems/problem_file.h"

namespace conebench::harness {

/// A failing problem, how it fails, and where the fewest of its cones that still do shall go.
struct ShrinkRequest {
  std::filesystem::path input, output;
  Shared<solvers::Solver> solver;
  solvers::Stop stop{};
  std::string failing{};  ///< harness/failure.h; empty: as the whole does
  Mode mode = Mode::kCold;
  std::uint64_t memory_limit_bytes = 0;
  std::optional<double> hard_limit_s{};
};

/// Where a search stands.
struct ShrinkState {
  int cones = 0;         ///< of the whole problem
  int smallest = 0;      ///< of the smallest part that is known to fail
  std::size_t runs = 0;  ///< of the solver
};

struct Shrunk {
  problems::Metadata whole{};
  int cones = 0;                    ///< of the whole
  std::vector<int> kept{};          ///< of the whole's cones; what `output` holds
  std::string failure{};            ///< what had to be seen: Failure::text()
  results::Record first{}, last{};  ///< the runs on the whole, and on the file that was written
  std::size_t runs = 0;
  bool minimal = false;    ///< without any one cone the solver does not fail so
  bool confirmed = false;  ///< the file, read again, makes the solver fail so
  bool interrupted = false;
};

/// Leaves out cones of a problem, and dofs that no remaining cone touches (problems/part.h), as
/// long as the solver fails in the same way (harness/failure.h, harness/ddmin.h). Every run is in a
/// worker process, as in a campaign, so that a crash or a hang is seen like any other failure. A
/// part that is no problem (its W too far from symmetric) counts as not failing.
///
/// `output` always holds the smallest part so far, replaced as one step; its name and origin say of
/// what it is a part, which cones it has, and how which solver fails on it. `watch` is told of
/// every run.
///
/// Deterministic for a solver that is; where a limit on time decides, other parts may be left.
/// Errors  InputError where the whole cannot be read or does not fail so, and where the output is
///         the input; OutputError where the output cannot be written.
Shrunk shrink(const ShrinkRequest& request, const std::function<void(const ShrinkState&)>& watch);

/// "0, 3-5, 9": increasing numbers, runs of three and more joined.
std::string ranges_text(const std::vector<int>& numbers);

}  // namespace conebench::harness
