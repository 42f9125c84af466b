#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace conebench::harness {

/// The verbs below one, in the order in which they were added.
std::vector<const CLI::App*> verbs_of(const CLI::App& app);

/// The options and positional arguments that --help shows, in its order.
std::vector<const CLI::Option*> options_of(const CLI::App& app);

/// "-s", "--solver": every way to say an option; empty for a positional argument.
std::vector<std::string> spellings(const CLI::Option& option);

/// What a value may be, from the type that --help shows ("own|SOLVER", "DIR", "TEXT:{a,b}") or, for
/// a positional argument without one, from its name.
struct ValueKind {
  bool solver = false, scene = false, file = false, folder = false;
  std::vector<std::string> words;  ///< literal ones; up to the first capital: "every:" of "every:N"
  bool many = false;               ///< takes more than one
};

/// Nothing of it is set for a number or a free text.
ValueKind value_kind(const CLI::Option& option);

/// True when the option is followed by a value.
bool takes_value(const CLI::Option& option);

}  // namespace conebench::harness
