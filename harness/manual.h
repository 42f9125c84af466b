#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace conebench::harness {

/// The program's manual in the language of man(1), section 1: every verb with all that its --help
/// says, so that the two cannot differ.
std::string man_page(const CLI::App& program);

}  // namespace conebench::harness
