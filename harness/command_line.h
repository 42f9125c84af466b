#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace conebench::harness {

/// The program's arguments as one line that a shell reads back, for the records. main() sets it.
void set_command_line(const std::vector<std::string>& arguments);
const std::string& command_line();

/// The whole program but for the exit: verbs, errors as one line on stderr, exit codes.
/// `arguments` without the program's name.
int run_program(const std::vector<std::string>& arguments);

}  // namespace conebench::harness
