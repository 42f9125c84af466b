#pragma once

#include <string>

#include "solvers/solver.h"

namespace conebench::harness {

/// What the solver was built to, so that results of two builds are never taken for each other: of
/// a `plugin:` or `exec:` the hash of its file's content (results::short_hash; not of what that
/// file loads or calls), of our own methods the GNU build-id of this program. [hex digits]
///
/// Cost  a file is read again only when its size or time has changed.
/// Errors  InputError naming the file when it cannot be read.
std::string build_of(const solvers::Solver& solver);

}  // namespace conebench::harness
