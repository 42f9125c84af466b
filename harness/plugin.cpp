#include "harness/plugin.h"

#include <memory>
#include <optional>

#include "harness/plugin_call.h"
#include "harness/plugin_probe.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

namespace fs = std::filesystem;
using problems::Problem;

// Loads when it is first asked for; copies of a solver share it, and so do forked workers what was
// loaded before.
class LoadedLater {
 public:
  explicit LoadedLater(fs::path path) : path_(std::move(path)) {}
  const PluginLibrary& get() {
    if (!library_) library_.emplace(path_);
    return *library_;
  }

 private:
  fs::path path_;
  std::optional<PluginLibrary> library_;
};

fs::path file_of(const solvers::VariantText& variants) {
  return fs::absolute(variants.name.substr(kPluginPrefix.size()));
}

solvers::Solver make_one(const solvers::Method& method, const solvers::Values& values,
                         const fs::path& path) {
  const auto library = std::make_shared<LoadedLater>(path);
  solvers::Solver solver = solvers::make_checked_solver(
      method, values,
      [library, values](const Problem& standard) {
        return ask_plugin(library->get(), values, standard);
      },
      [library, values](const Problem& standard, const solvers::Stop& stop,
                        const Eigen::VectorXd& guess, solvers::Monitor& monitor) {
        return call_plugin(library->get(), values, standard, stop, guess, monitor);
      });
  solver.program = path;
  return solver;
}

solvers::Method method_of(const std::string& name, const PluginDescription& description,
                          const fs::path& path) {
  solvers::Method method{.name = name,
                         .kind = solvers::Kind::kPeer,
                         .summary = description.summary,
                         .parameters = description.parameters,
                         .make = {}};
  method.make = [method, path](const solvers::Values& values) {
    return make_one(method, values, path);
  };
  return method;
}

// A library that did not say what it is: a worker sees for itself.
solvers::Solver unknown_solver(const std::string& name, const fs::path& path,
                               const std::string& trouble) {
  solvers::Solver solver;
  solver.name = name;
  solver.kind = solvers::Kind::kPeer;
  solver.program = path;
  solver.refuses = [=](const Problem&) -> std::optional<std::string> {
    const PluginLibrary library(path);
    throw std::runtime_error("its parameters could not be read: " + trouble);
  };
  solver.solve = [refuses = solver.refuses](const Problem& standard, const solvers::Request&) {
    refuses(standard);
    return solvers::Result();
  };
  return solver;
}

}  // namespace

solvers::Method plugin_method(const solvers::VariantText& name) {
  const fs::path path = file_of(name);
  const PluginProbe probe = probe_plugin(path);
  problems::require(probe.description.has_value(), name.name,
                    "cannot say what it is: ", probe.trouble);
  return method_of(name.name, *probe.description, path);
}

std::vector<solvers::Solver> make_plugin_solvers(const solvers::VariantText& variants) {
  const fs::path path = file_of(variants);
  const PluginProbe probe = probe_plugin(path);
  if (probe.description) {
    return solvers::make_variants(method_of(variants.name, *probe.description, path), variants,
                                  variants.name);
  }
  std::vector<solvers::Solver> unknown;
  for (const auto& values : variants.combinations()) {
    unknown.push_back(
        unknown_solver(solvers::variant_text(variants.name, values), path, probe.trouble));
  }
  return unknown;
}

}  // namespace conebench::harness
