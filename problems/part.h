#pragma once

#include <span>

#include "problems/problem_file.h"

namespace conebench::problems {

/// The rows of these cones, in their order.
std::vector<int> rows_of(const Problem& problem, std::span<const int> cones);

/// The problem in which only some cones of another act: their rows and laws as they stand, and of
/// the dofs those in a connected component of M that one of the cones touches, so that
///
///   W_part = W(rows, rows),   q_part = q(rows).
///
/// Its rate scale is the whole's, as an island's is: eta is measured against the same U. It is
/// built and checked as if it had been read from a file.
///
/// `cones`: increasing, of the whole problem. Cost: a copy, and M is factorised again.
/// Errors  InputError for cones that are not there or not in order, and where the part is no
///         problem (|W - W^T| / |W| of a part can be larger than the whole's).
Problem part_of(const Problem& whole, std::span<const int> cones, Metadata metadata);

/// The same of what lies in a file: of the geometry the rows of these cones, and the bodies that
/// they join, renumbered (all bodies where the file does not say which cone joins which); the rows
/// of guess and solution, with the eta that the solution's r has in the part. It need not solve it.
ProblemFile part_of(const ProblemFile& whole, std::span<const int> cones, Metadata metadata);

}  // namespace conebench::problems
