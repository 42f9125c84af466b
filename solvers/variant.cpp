// From a solver's text form to solvers: which method, the values checked, the canonical spelling.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "problems/error.h"
#include "problems/suggest.h"
#include "solvers/external.h"
#include "solvers/registry.h"
#include "solvers/variant_text.h"

namespace conebench::solvers {
namespace {

using problems::InputError;
using problems::require;

const Method& find_method(std::string_view name, std::string_view variant) {
  std::vector<std::string> known;
  for (const Method& method : all_methods()) {
    if (method.name == name) return method;
    known.push_back(method.name);
  }
  throw InputError(variant, fmt::format("no solver '{}'{}; known: {}", name,
                                        problems::suggestion(name, known), fmt::join(known, ", ")));
}

const Parameter& find_parameter(const Method& method, std::string_view key,
                                std::string_view variant) {
  std::vector<std::string> known;
  for (const Parameter& parameter : method.parameters) {
    if (parameter.name == key) return parameter;
    known.push_back(parameter.name);
  }
  throw InputError(variant, fmt::format("{} has no parameter '{}'{}; known: {}", method.name, key,
                                        problems::suggestion(key, known), fmt::join(known, ", ")));
}

template <class Number>
Number number(const Parameter& parameter, const std::string& text, std::string_view variant) {
  Number value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  require(error == std::errc{} && end == text.data() + text.size(), variant, parameter.name,
          " is '", text, "', expected a number");
  const auto x = static_cast<double>(value);
  require(x >= parameter.low && x <= parameter.high, variant, parameter.name, " is ", text,
          ", expected ", parameter.low, " to ", parameter.high);
  return value;
}

Value convert(const Parameter& parameter, const std::string& text, std::string_view variant) {
  if (std::holds_alternative<double>(parameter.fallback)) {
    return number<double>(parameter, text, variant);
  }
  if (std::holds_alternative<std::int64_t>(parameter.fallback)) {
    return number<std::int64_t>(parameter, text, variant);
  }
  if (std::holds_alternative<bool>(parameter.fallback)) {
    require(text == "true" || text == "false", variant, parameter.name, " is '", text,
            "', expected true or false");
    return text == "true";
  }
  const auto& choices = parameter.choices;
  if (!choices.empty() && std::find(choices.begin(), choices.end(), text) == choices.end()) {
    throw InputError(variant,
                     fmt::format("{} is '{}'{}; known: {}", parameter.name, text,
                                 problems::suggestion(text, choices), fmt::join(choices, ", ")));
  }
  return text;
}

std::string spelled(const Value& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *whole);
  return fmt::format("{}", std::get<double>(value));
}

}  // namespace

std::vector<Solver> make_variants(const Method& method, const VariantText& text,
                                  std::string_view subject) {
  Values defaults;
  for (const Parameter& parameter : method.parameters)
    defaults[parameter.name] = parameter.fallback;
  std::vector<Solver> solvers;
  for (const auto& combination : text.combinations()) {
    Values values = defaults;
    for (const auto& [key, value] : combination) {
      values[key] = convert(find_parameter(method, key, subject), value, subject);
    }
    solvers.push_back(method.make(values));
  }
  return solvers;
}

std::vector<Solver> make_solvers(std::string_view variants) {
  const VariantText file = parse_file_variant(variants);
  if (file.name.starts_with(kExternalPrefix)) return make_external_solvers(file);
  const VariantText text = parse_variant(variants);
  return make_variants(find_method(text.name, variants), text, variants);
}

Solver make_solver(std::string_view variant) {
  std::vector<Solver> solvers = make_solvers(variant);
  require(solvers.size() == 1, variant, "names ", solvers.size(), " solvers, expected one");
  return std::move(solvers.front());
}

std::string identity(const Method& method, const Values& values) {
  std::map<std::string, std::string> given;
  for (const auto& [key, value] : values) {
    const auto& schema = method.parameters;
    const auto parameter = std::find_if(schema.begin(), schema.end(),
                                        [&](const Parameter& p) { return p.name == key; });
    if (parameter != schema.end() && value != parameter->fallback) given[key] = spelled(value);
  }
  return variant_text(method.name, given);
}

}  // namespace conebench::solvers
