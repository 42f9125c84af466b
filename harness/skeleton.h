#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace conebench::harness {

/// A file of examples/LANGUAGE, carried inside the program.
struct SkeletonFile {
  std::string_view language;  ///< "c", "c++" or "python"
  std::string_view name;      ///< e.g. "my_solver.c"
  std::string_view text;
};

std::span<const SkeletonFile> skeleton_files();

/// Writes a solver that works, in that language, into `folder` (made if need be): the example,
/// under another name. Returns the files. Throws InputError for a name that is none (letters,
/// digits, '_' and '-', a letter first), an unknown language or a file that is there already, in
/// which case nothing is written; OutputError when the folder is not writable.
std::vector<std::filesystem::path> write_skeleton(const std::string& name,
                                                  const std::string& language,
                                                  const std::filesystem::path& folder);

}  // namespace conebench::harness
