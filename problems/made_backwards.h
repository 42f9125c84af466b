#pragma once

#include <cstdint>
#include <vector>

#include "problems/problem.h"

namespace conebench::problems {

/// What a made-backwards problem should be like.
enum class Family {
  kGeneric,        ///< two rows to three dofs; W is regular but for cones of many rows (d = 6)
                   ///< that share their bodies
  kRankDeficient,  ///< W singular: about twice as many rows as dofs; r not unique
  kSingularBlock,  ///< some W_ii lose a tangential direction (a zero row of H)
  kSeveral,        ///< one wedged cone a body, with two solutions of different u
  kInfeasible,     ///< no solution, by construction: pairs of opposed walls that close in
};

struct Recipe {
  Family family = Family::kGeneric;
  int cones = 20;                      ///< >= 1
  std::vector<int> dims = {3};         ///< dealt out in turn, each >= 1
  double mu_low = 0.1, mu_high = 0.8;  ///< mu is uniform in this range, >= 0
  double theta_share = 1.0;            ///< theta = share mu, 0 to 1; 1 is Coulomb
  double cohesive_share = 0.0;         ///< of cones with kappa > 0, 0 to 1
  double mass_ratio = 10.0;            ///< heaviest to lightest body, >= 1
  bool reduced = false;                ///< give (W, q) instead of (M, H, f, w)
  std::uint64_t seed = 1;
};

/// A problem and what is known of it by construction.
struct MadeProblem {
  Problem problem;
  /// Reactions r' of the standard problem that solve it (two for kSeveral, none for kInfeasible).
  std::vector<Eigen::VectorXd> solutions;
};

/// Draws complementary pairs (u_i, r'_i) in every contact state (open, stick, slide, and the cone's
/// tip r' = 0 with u = 0), random M and H, and then sets f and w so that they solve the problem.
///
/// The same recipe gives the same problem on every machine with the same floating point.
/// Cost  linear in cones (bodies touch four cones on average), plus W when `reduced`.
/// Errors  InputError naming what is wrong in the recipe.
MadeProblem make_backwards(const Recipe& recipe);

}  // namespace conebench::problems
