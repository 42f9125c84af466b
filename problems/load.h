#pragma once

#include <filesystem>
#include <vector>

#include "problems/problem_file.h"

namespace conebench::problems {

/// Reads one problem in any format we know, recognised by content, not by extension: our own HDF5,
/// FCLIB local or global HDF5, Siconos .dat. Throws InputError naming file and dataset.
ProblemFile load_problem(const std::filesystem::path& path);

/// Files and folders (recursive), in sorted order, each readable problem file once by path.
struct FoundProblems {
  std::vector<std::filesystem::path> files;
  int skipped = 0;  ///< files in folders that are no problem file
};

/// A path that does not exist, or that is named and is no problem file, is an InputError.
FoundProblems find_problems(const std::vector<std::filesystem::path>& paths);

}  // namespace conebench::problems
