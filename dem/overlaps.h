#pragma once

#include <string_view>

#include "dem/placement.h"

namespace conebench::dem {

/// Throws InputError naming the first two things of a placement that overlap by more than
/// kOverlapTolerance.
void refuse_overlaps(int dimension, std::string_view subject, const Placement& placement);

/// Moves bodies apart until no two overlap (see place_bodies).
void resolve_overlaps(int dimension, std::string_view subject, Placement& placement);

}  // namespace conebench::dem
