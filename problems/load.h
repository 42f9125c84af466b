#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "problems/problem_file.h"

namespace conebench::problems {

enum class FileFormat { kConebench, kFclib, kSiconosDat, kUnknown };

std::string_view to_string(FileFormat format);  // "conebench", "fclib", "siconos-dat", "unknown"

/// What the file is, by content alone; looks at its first bytes and, in HDF5, at its groups.
/// Throws InputError for a file that starts as HDF5 and is damaged.
FileFormat file_format(const std::filesystem::path& path);

/// Reads one problem in any format we know, recognised by content, not by extension: our own HDF5,
/// FCLIB local or global HDF5, Siconos .dat. Throws InputError naming file and dataset.
ProblemFile load_problem(const std::filesystem::path& path);

/// Files in the order given, folders (recursive) in sorted order, each file once. Hidden files
/// and collection.json are passed over. A damaged HDF5 file is among them, so that loading it says
/// what is wrong.
struct FoundProblems {
  std::vector<std::filesystem::path> files;
  int skipped = 0;  ///< files in folders that are no problem file
};

/// A path that does not exist, or that is named and is no problem file, is an InputError.
FoundProblems find_problems(const std::vector<std::filesystem::path>& paths);

}  // namespace conebench::problems
