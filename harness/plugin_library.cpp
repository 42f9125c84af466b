#include "harness/plugin_library.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "problems/error.h"

namespace conebench::harness {
namespace {

namespace fs = std::filesystem;
using problems::require;

using Entry = const conebench_plugin* (*)();
constexpr const char* kEntry = "conebench_plugin_entry";

const conebench_plugin* load(const fs::path& path) {
  void* library = ::dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw problems::InputError(path.string(), ::dlerror());
  const auto entry = reinterpret_cast<Entry>(::dlsym(library, kEntry));
  require(entry != nullptr, path.string(), "has no function ", kEntry,
          ", expected a library made with harness/plugin_api.h");
  const conebench_plugin* plugin = entry();
  require(plugin != nullptr, path.string(), kEntry, "() returned NULL, expected a plugin");
  return plugin;
}

void check_size(const fs::path& path, const char* what, std::size_t found, std::size_t expected) {
  if (found == expected) return;
  throw BadAbi(path, fmt::format("its {} has {} bytes, expected {}", what, found, expected));
}

void check_abi(const fs::path& path, const conebench_plugin& plugin) {
  check_size(path, "conebench_plugin", plugin.struct_size, sizeof(conebench_plugin));
  if (plugin.abi_version == CONEBENCH_ABI_VERSION) return;
  throw BadAbi(path, fmt::format("speaks version {} of harness/plugin_api.h, expected {}",
                                 plugin.abi_version, CONEBENCH_ABI_VERSION));
}

std::string text(const char* given) { return given == nullptr ? "" : given; }

bool is_name(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '_' || c == '-';
  });
}

solvers::Value fallback_of(const fs::path& path, const conebench_parameter& p) {
  switch (p.type) {
    case CONEBENCH_BOOLEAN:
      return p.fallback.boolean != 0;
    case CONEBENCH_INTEGER:
      return p.fallback.integer;
    case CONEBENCH_REAL:
      return p.fallback.real;
    case CONEBENCH_TEXT:
      return text(p.fallback.text);
    default:
      throw problems::InputError(
          path.string(), fmt::format("parameter {} is of type {}, expected 0 to 3 (conebench_type)",
                                     p.name, p.type));
  }
}

void check_fallback(const fs::path& path, const solvers::Parameter& p) {
  const bool allowed = std::visit(
      [&](const auto& value) {
        using Type = std::decay_t<decltype(value)>;
        if constexpr (std::is_same_v<Type, bool>) {
          return true;
        } else if constexpr (std::is_same_v<Type, std::string>) {
          return p.choices.empty() || std::ranges::count(p.choices, value) > 0;
        } else {
          const auto number = static_cast<double>(value);
          return number >= p.low && number <= p.high;
        }
      },
      p.fallback);
  require(allowed, path.string(), "the default of parameter ", p.name, " is not in its range");
}

solvers::Parameter checked(const fs::path& path, const conebench_parameter& given) {
  check_size(path, "conebench_parameter", given.struct_size, sizeof(conebench_parameter));
  check_size(path, "conebench_value", given.fallback.struct_size, sizeof(conebench_value));
  const std::string name = text(given.name);
  require(is_name(name), path.string(), "a parameter is called '", name,
          "', expected letters, digits, '_' and '-'");
  solvers::Parameter parameter{.name = name, .fallback = fallback_of(path, given)};
  parameter.doc = text(given.doc);
  const bool is_number = given.type == CONEBENCH_INTEGER || given.type == CONEBENCH_REAL;
  if (is_number) {
    parameter.low = given.low;
    parameter.high = given.high;
  }
  if (given.type == CONEBENCH_TEXT && given.choices != nullptr) {
    for (const char* const* choice = given.choices; *choice != nullptr; ++choice) {
      parameter.choices.emplace_back(*choice);
    }
  }
  check_fallback(path, parameter);
  return parameter;
}

}  // namespace

PluginLibrary::PluginLibrary(const fs::path& path) : path_(path), plugin_(load(path)) {
  check_abi(path, *plugin_);
  require(plugin_->solve != nullptr, path.string(), "solve is NULL, expected a function");
  for (std::size_t k = 0; k < plugin_->parameter_count; ++k) {
    parameters_.push_back(checked(path, plugin_->parameters[k]));
    const auto same = [&](const solvers::Parameter& p) { return p.name == parameters_[k].name; };
    require(std::ranges::count_if(parameters_, same) == 1, path.string(), "two parameters are ",
            parameters_[k].name);
  }
}

}  // namespace conebench::harness
