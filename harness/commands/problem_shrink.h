#pragma once

#include <CLI/CLI.hpp>

namespace conebench::harness {

/// Adds `shrink` to the verbs of `conebench problem`; as the functions of commands.h.
void add_problem_shrink(CLI::App& problem, int& exit_code);

}  // namespace conebench::harness
