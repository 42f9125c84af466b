#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace conebench::harness {

/// Names that the verbs take and their tree does not hold.
struct CompletionNames {
  std::vector<std::string> solvers, scenes;
};

/// A script that teaches bash (4.4 or later) the command line: every verb and option, and for
/// values the words that --help shows, names, files or folders. Needs nothing of the package
/// bash-completion.
std::string bash_completion(const CLI::App& program, const CompletionNames& names);

}  // namespace conebench::harness
