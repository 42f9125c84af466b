#pragma once

#include <string>
#include <vector>

#include "results/profiles.h"

namespace conebench::results {

/// Two solvers that change places when something is left out.
struct Flip {
  std::string left_out;       ///< a scene or a solver
  std::string first, second;  ///< as all of the results rank them; without `left_out` the other way

  bool operator==(const Flip&) const = default;
};

/// The places that a solver takes, 1 is best. Where another solver is left out the remaining ones
/// keep their numbers, so that only a change of order shows.
struct PlaceRange {
  std::string solver;
  int place = 0;                                ///< with everything
  int best_by_scene = 0, worst_by_scene = 0;    ///< leaving one scene out
  int best_by_solver = 0, worst_by_solver = 0;  ///< leaving one other solver out
};

struct Stability {
  std::vector<PlaceRange> places;  ///< best first
  std::vector<Flip> scene_flips, solver_flips;
};

/// rank() over and over: with each scene left out in turn, and with each solver left out, where the
/// performance profiles are recomputed for those that are left. The order of two solvers may depend
/// on a third (Gould and Scott, ACM TOMS 43(2), 2016).
/// Cost: (scenes + solvers) rankings.
Stability rank_stability(const TimeTable& table);

}  // namespace conebench::results
