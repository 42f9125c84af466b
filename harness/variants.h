#pragma once

#include <string_view>
#include <vector>

#include "solvers/solver.h"

namespace conebench::harness {

/// As solvers::make_solvers, and "plugin:FILE[key=value,...]" (harness/plugin.h): what every verb
/// takes for a solver.
std::vector<solvers::Solver> make_solvers(std::string_view variants);

/// The same for one solver; lists are an InputError.
solvers::Solver make_solver(std::string_view variant);

}  // namespace conebench::harness
