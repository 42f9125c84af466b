#pragma once

#include <filesystem>

#include "dem/shape.h"

namespace conebench::dem {

/// The triangles of an OBJ or STL file, by the end of its name (.obj, .stl), lengths in metres.
///
/// OBJ: `v` and `f` in all forms; polygons are cut into a fan from their first corner, which is
/// right where they are convex. Names, materials, texture and normals are passed over; curves and
/// free-form surfaces are refused. STL: text or binary, told by the content; vertices with equal
/// coordinates become one; normals are not read, the order of the corners says what is outside.
///
/// Errors: InputError naming file and line, or byte of a binary file. What the triangles make is
/// left to check_piece().
Mesh read_mesh(const std::filesystem::path& file);

}  // namespace conebench::dem
