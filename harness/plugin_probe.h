#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "solvers/solver.h"

namespace conebench::harness {

/// What a plugin says of itself.
struct PluginDescription {
  std::string name, summary;
  std::vector<solvers::Parameter> parameters;
};

/// What came of asking: a description, or why there is none.
struct PluginProbe {
  std::optional<PluginDescription> description;
  std::string trouble;  ///< "SIGSEGV (Segmentation fault)", "speaks version 7 ..."; else empty
};

/// Loads the library in a child process, so that a constructor that crashes or hangs harms nothing
/// here, and reads name, summary and parameters.
///
/// Cost  some milliseconds; 5 s with a library that hangs.
/// Errors  InputError naming the file when it is missing, no library, or none of ours.
PluginProbe probe_plugin(const std::filesystem::path& path);

}  // namespace conebench::harness
