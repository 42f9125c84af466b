#pragma once

#include <string>

#include "problems/sparse.h"
#include "problems/text_reader.h"

namespace conebench::problems {

/// Reads one matrix of Siconos' text format, in any of its three storages, at the reader's place.
/// `name` is for messages. Throws InputError naming file and line.
SparseMatrix read_siconos_matrix(TextReader& in, const std::string& name);

}  // namespace conebench::problems
