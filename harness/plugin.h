#pragma once

#include <string_view>
#include <vector>

#include "solvers/registry.h"
#include "solvers/variant_text.h"

namespace conebench::harness {

/// How a variant that names a shared library begins: "plugin:./my_solver.so".
inline constexpr std::string_view kPluginPrefix = "plugin:";

/// The library as a method, a peer, with its parameters. Throws problems::InputError naming the
/// file when it is missing, no library of ours, or will not say what it is (a crash, another ABI).
solvers::Method plugin_method(const solvers::VariantText& name);

/// The solvers of "plugin:FILE[key=value,...]"; lists make grids. The library is asked for its
/// parameters in a child process and loaded where it first solves: in a worker. One that crashes,
/// hangs or speaks another ABI when it is asked still gives a solver, whose tasks end that way.
///
/// Errors  InputError naming the file when it is missing or no library of ours; naming the
///         parameter or value that the library does not know.
std::vector<solvers::Solver> make_plugin_solvers(const solvers::VariantText& variants);

}  // namespace conebench::harness
