#pragma once

#include <filesystem>

#include "problems/problem_file.h"

namespace conebench::problems {

/// Reads a file of the FCLIB collection: /fclib_local (W, q, mu) or /fclib_global (M, H, f, w, mu),
/// matrices in triplets or compressed by rows or columns. Cones are Coulomb's (theta = mu) without
/// cohesion, of dimension `spacedim`; a root attribute rate_scale is kept. /solution is read unless
/// all zeros, and its eta computed; /guesses/1/r likewise is the guess.
/// Throws InputError naming file and dataset; bilateral constraints (groups G, V, R) are refused.
ProblemFile read_fclib(const std::filesystem::path& path);

/// Writes a file that holds only FCLIB's layout: global for the primal form, local for the reduced
/// one. With cohesion it holds the standard (shifted) problem, its info says so, and the root
/// attribute rate_scale keeps eta's scale. Atomic. Throws InputError when FCLIB cannot hold the
/// problem (mixed dims, dims other than 2, 3, 6, theta < mu), OutputError when the disk fails.
void write_fclib_file(const std::filesystem::path& path, const ProblemFile& file);

}  // namespace conebench::problems
