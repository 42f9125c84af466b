// The text form of a solver: name[key=value,...], its checks and its canonical spelling.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "problems/error.h"
#include "problems/suggest.h"
#include "solvers/external.h"
#include "solvers/registry.h"

namespace conebench::solvers {
namespace {

using problems::InputError;
using problems::require;

struct Item {
  std::string key;
  std::vector<std::string> values;
};

struct Parsed {
  std::string method;
  std::vector<Item> items;
};

std::string trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return std::string(text.substr(first, text.find_last_not_of(" \t") - first + 1));
}

Parsed parse(std::string_view text) {
  const auto open = text.find('[');
  Parsed parsed{trimmed(text.substr(0, open)), {}};
  if (open == std::string_view::npos) return parsed;
  require(text.back() == ']', text, "has '[' without a final ']', expected name[key=value,...]");
  std::string_view body = text.substr(open + 1, text.size() - open - 2);
  while (!trimmed(body).empty()) {
    const auto comma = body.find(',');
    const std::string_view item = body.substr(0, comma);
    const auto equals = item.find('=');
    if (equals != std::string_view::npos) {
      parsed.items.push_back({trimmed(item.substr(0, equals)), {trimmed(item.substr(equals + 1))}});
    } else {
      require(!parsed.items.empty(), text, "starts with '", trimmed(item),
              "', expected name[key=value,...]");
      parsed.items.back().values.push_back(trimmed(item));
    }
    body = comma == std::string_view::npos ? std::string_view{} : body.substr(comma + 1);
  }
  return parsed;
}

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
  if (std::find(choices.begin(), choices.end(), text) == choices.end()) {
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

std::vector<Solver> make_solvers(std::string_view variants) {
  const std::string whole = trimmed(variants);
  if (whole.starts_with(kExternalPrefix)) return {make_external_solver(whole)};
  const Parsed parsed = parse(whole);
  const Method& method = find_method(parsed.method, variants);
  Values defaults;
  for (const Parameter& parameter : method.parameters)
    defaults[parameter.name] = parameter.fallback;
  std::vector<Values> grid{defaults};
  for (const Item& item : parsed.items) {
    const Parameter& parameter = find_parameter(method, item.key, variants);
    std::vector<Values> wider;
    for (const Values& values : grid) {
      for (const std::string& text : item.values) {
        wider.push_back(values);
        wider.back()[item.key] = convert(parameter, text, variants);
      }
    }
    grid = std::move(wider);
  }
  std::vector<Solver> solvers;
  for (const Values& values : grid) solvers.push_back(method.make(values));
  return solvers;
}

Solver make_solver(std::string_view variant) {
  std::vector<Solver> solvers = make_solvers(variant);
  require(solvers.size() == 1, variant, "names ", solvers.size(), " solvers, expected one");
  return std::move(solvers.front());
}

std::string identity(const Method& method, const Values& values) {
  std::vector<std::string> items;
  for (const auto& [key, value] : values) {
    const auto& schema = method.parameters;
    const auto parameter = std::find_if(schema.begin(), schema.end(),
                                        [&](const Parameter& p) { return p.name == key; });
    if (parameter != schema.end() && value != parameter->fallback) {
      items.push_back(key + "=" + spelled(value));
    }
  }
  if (items.empty()) return method.name;
  return fmt::format("{}[{}]", method.name, fmt::join(items, ","));
}

}  // namespace conebench::solvers
