#pragma once

#include <map>
#include <span>

#include "solvers/solver.h"

namespace conebench::solvers {

/// Parameter values by name; complete once a method has filled in its defaults.
using Values = std::map<std::string, Value>;

/// A method before its parameters are set: what `conebench solver list` shows.
struct Method {
  std::string name;
  Kind kind = Kind::kMethod;
  std::string summary;   ///< one line
  std::string source{};  ///< papers, and what of them was not checked; the header says more
  std::vector<Parameter> parameters;
  std::function<Solver(const Values&)> make;  ///< values checked and complete
};

/// Every method of this program, in the order of the table in registry.cpp.
std::span<const Method> all_methods();

/// One solver from "gs" or "gs[local=projection,omega=0.8]".
/// Errors: InputError naming the unknown method, parameter or value, with a suggestion.
Solver make_solver(std::string_view variant);

/// As make_solver, but lists make grids: "gs[omega=0.8,1.0]" is two solvers. Inside [], an item
/// without `=` continues the previous list.
std::vector<Solver> make_solvers(std::string_view variants);

struct VariantText;

/// Every variant of one method that the parsed text gives; `subject` is what errors name.
std::vector<Solver> make_variants(const Method& method, const VariantText& text,
                                  std::string_view subject);

/// name[keys sorted, defaults omitted].
std::string identity(const Method& method, const Values& values);

}  // namespace conebench::solvers
