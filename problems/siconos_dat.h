#pragma once

#include <filesystem>

#include "problems/problem_file.h"

namespace conebench::problems {

/// Reads Siconos' text format. Local (W, q, mu) when the first matrix has dimension x contacts
/// rows, else global (M, H, q, b, mu: M v = q + H r, u = H^T v + b, our f and w). Matrices may be
/// dense, sparse by blocks (both column by column) or sparse. Cones are Coulomb's, no cohesion.
/// Entries of a dense matrix below 2.2e-16 times its largest are rounding and read as zeros, as
/// Siconos does when it makes such a matrix sparse; all other numbers are kept to the last bit.
/// Throws InputError naming file and line for anything cut short, garbled or left over.
ProblemFile read_siconos_dat(const std::filesystem::path& path);

/// True when the text starts as such a file does: a dimension, a number of contacts, a storage.
bool looks_like_siconos_dat(std::string_view text);

}  // namespace conebench::problems
