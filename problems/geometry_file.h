#pragma once

// Internal to problems/: the group /geometry of our files.

#include "problems/hdf5_file.h"

namespace conebench::problems {

/// Writes the tables that are not empty. Throws InputError when one has another number of rows
/// than there are cones, or bodies.
void write_geometry(hdf5::Writer& writer, const Geometry& geometry, const Problem& problem);

/// The tables that are there; nothing without the group.
std::optional<Geometry> read_geometry(const hdf5::Reader& reader, int cones);

}  // namespace conebench::problems
