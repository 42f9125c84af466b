#pragma once

// Internal to problems/: FCLIB's own layout, written beside ours or alone.

#include "problems/hdf5_file.h"

namespace conebench::problems {

/// FCLIB knows Coulomb friction with one dimension for all cones: 2, 3 or 6 here.
bool fits_fclib(const Problem& problem);

/// Where the numbers of the view come from.
enum class FclibArrays {
  kLinked,  ///< second names for the arrays of /problem wherever the numbers are the same
  kOwn,     ///< arrays of its own; there is no /problem
};

/// Writes /fclib_global or /fclib_local after the form of `problem`, which must fit. With cohesion
/// it holds the shifted problem and says so in its info. Matrices are stored by columns, the one
/// compressed layout that every reader of FCLIB takes.
void write_fclib_view(hdf5::Writer& writer, const Problem& problem, FclibArrays arrays);

}  // namespace conebench::problems
