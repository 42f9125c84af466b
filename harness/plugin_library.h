#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "harness/plugin_api.h"
#include "solvers/solver.h"

namespace conebench::harness {

/// A library that speaks another version of harness/plugin_api.h, or does not keep to this one.
/// A task ends as results::Status::kBadAbi when a solver throws it.
class BadAbi : public std::runtime_error {
 public:
  BadAbi(const std::filesystem::path& library, const std::string& detail)
      : std::runtime_error(library.string() + ": " + detail) {}
};

/// A shared library that is a solver, loaded into *this* process for the rest of its life: its
/// constructors run, and may do anything. Only workers and probes make one.
class PluginLibrary {
 public:
  /// Nothing of the library is read before its version and the sizes of its structures agree.
  /// Throws BadAbi where they do not; InputError naming the file when it cannot be loaded, has no
  /// conebench_plugin_entry(), or describes a parameter that is none.
  explicit PluginLibrary(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  const conebench_plugin& plugin() const { return *plugin_; }
  const std::vector<solvers::Parameter>& parameters() const { return parameters_; }

 private:
  std::filesystem::path path_;
  const conebench_plugin* plugin_ = nullptr;
  std::vector<solvers::Parameter> parameters_;
};

}  // namespace conebench::harness
