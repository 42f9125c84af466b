#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "dem/contacts.h"
#include "dem/placement.h"

namespace conebench::dem {

/// Throws InputError naming the first two things of a placement that overlap by more than
/// kOverlapTolerance.
void refuse_overlaps(int dimension, std::string_view subject, const Placement& placement);

/// Moves bodies apart until no two overlap (see place_bodies).
void resolve_overlaps(int dimension, std::string_view subject, Placement& placement);

/// Throws InputError naming the first contact in which one has sunk into the other by more than
/// half of the thinner one's thickness: contacts do not push bodies out again, so that what follows
/// would mean nothing.
void refuse_sunk(const Scene& scene, std::int64_t step, std::span<const Contact> contacts,
                 const Placement& placement);

/// Throws InputError naming the first body that starts so fast, or under so much gravity, that it
/// moves farther in a step than it is thick: it could pass another one unseen.
void refuse_long_step(const Scene& scene, std::string_view subject, const Placement& placement);

}  // namespace conebench::dem
