#pragma once

#include <cstddef>
#include <vector>

#include "results/profiles.h"

namespace conebench::results {

/// The rows of a table, hardest first: by the share of the solvers run that fail, then by the time
/// of the quickest. Ties stay in the order of the table.
std::vector<std::size_t> hardest_first(const TimeTable& table);

}  // namespace conebench::results
