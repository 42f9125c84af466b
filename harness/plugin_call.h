#pragma once

#include <optional>
#include <string>

#include "harness/plugin_library.h"
#include "solvers/method.h"

namespace conebench::harness {

/// Asks the library why it will not take the problem; nothing if it will.
std::optional<std::string> ask_plugin(const PluginLibrary& library, const solvers::Values& values,
                                      const problems::Problem& standard);

/// Has the library solve the problem, in this process: a solvers::Iterate. `guess` has rows()
/// entries. Its claims are passed on, for the caller to verify; an r of another length than rows()
/// comes back empty, with a note. Throws BadAbi for a status that there is none; what a C++ library
/// throws passes through.
///
/// Cost  a few arrays of one entry a cone; matrices are handed over as they are.
solvers::Result call_plugin(const PluginLibrary& library, const solvers::Values& values,
                            const problems::Problem& standard, const solvers::Stop& stop,
                            const Eigen::VectorXd& guess, solvers::Monitor& monitor);

}  // namespace conebench::harness
