#pragma once

#include <CLI/CLI.hpp>
#include <span>
#include <string>
#include <vector>

namespace conebench::harness {

/// The program's arguments as one line that a shell reads back, for the records. main() sets it.
void set_command_line(const std::vector<std::string>& arguments);
const std::string& command_line();

/// What --help and the manual say of the program as a whole.
struct Example {
  const char* command;
  const char* what;
};
struct ExitCode {
  int code;
  const char* meaning;
};
std::span<const Example> program_examples();
std::span<const ExitCode> program_exit_codes();

/// The whole program but for the exit: verbs, errors as one line on stderr, exit codes.
/// `arguments` without the program's name.
int run_program(const std::vector<std::string>& arguments);

}  // namespace conebench::harness
