#include "harness/variants.h"

#include "harness/plugin.h"
#include "problems/error.h"

namespace conebench::harness {

std::vector<solvers::Solver> make_solvers(std::string_view variants) {
  const solvers::VariantText file = solvers::parse_file_variant(variants);
  if (file.name.starts_with(kPluginPrefix)) return make_plugin_solvers(file);
  return solvers::make_solvers(variants);
}

solvers::Solver make_solver(std::string_view variant) {
  std::vector<solvers::Solver> made = make_solvers(variant);
  problems::require(made.size() == 1, variant, "names ", made.size(), " solvers, expected one");
  return std::move(made.front());
}

}  // namespace conebench::harness
