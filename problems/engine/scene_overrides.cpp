#include <fmt/format.h>

#include <charconv>
#include <sstream>

#include "problems/engine/scene_file.h"
#include "problems/error.h"
#include "problems/suggest.h"

namespace conebench::engine {
namespace {

using problems::InputError;

// One step of a path: a key of a table, or a place in an array.
struct Step {
  std::string key;
  std::size_t place = 0;
  bool is_place() const { return key.empty(); }
};

std::size_t read_place(std::string_view digits, const std::string& path) {
  std::size_t place = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), place);
  problems::require(error == std::errc{} && end == digits.data() + digits.size(), path, "found [",
                    digits, "], expected a place in an array such as [0]");
  return place;
}

// "blocks[0].high_m" is blocks, 0, high_m.
std::vector<Step> split(const std::string& path) {
  std::vector<Step> steps;
  std::string_view rest = path;
  while (true) {
    const std::size_t end = std::min(rest.find_first_of(".["), rest.size());
    problems::require(end > 0, path, "has an empty key, expected such as material.friction");
    steps.push_back({.key = std::string(rest.substr(0, end))});
    rest.remove_prefix(end);
    while (rest.starts_with('[')) {
      const std::size_t close = std::min(rest.find(']'), rest.size());
      steps.push_back({.key = {}, .place = read_place(rest.substr(1, close - 1), path)});
      rest.remove_prefix(std::min(close + 1, rest.size()));
    }
    if (rest.empty()) return steps;
    problems::require(rest.starts_with('.'), path, "found \"", rest, "\", expected '.' or '['");
    rest.remove_prefix(1);
  }
}

// TOML, or else a word. Text that starts as TOML's strings, arrays or tables do is no word.
toml::table read_value(const std::string& text, const std::string& path) {
  try {
    toml::table table = toml::parse("value = " + text);
    problems::require(table.size() == 1, path, "found more than a value");
    return table;
  } catch (const toml::parse_error& error) {
    problems::require(text.find_first_of("\"'[{\n") != 0 && !text.empty(), path, "found ", text,
                      ", expected a TOML value: ", error.description());
    return toml::table{{"value", text}};
  }
}

std::vector<std::string> keys_of(const toml::table& table) {
  std::vector<std::string> keys;
  for (const auto& [key, node] : table) keys.emplace_back(key.str());
  return keys;
}

// The node that a step leads to, or null.
toml::node* follow(toml::node& from, const Step& step) {
  if (step.is_place()) return from.is_array() ? from.as_array()->get(step.place) : nullptr;
  return from.is_table() ? from.as_table()->get(step.key) : nullptr;
}

[[noreturn]] void fail_at(const toml::node& from, const Step& step, const std::string& path) {
  if (step.is_place()) {
    const auto count = from.is_array() ? from.as_array()->size() : 0;
    throw InputError(path, fmt::format("no place [{}], the array has {}", step.place, count));
  }
  const auto keys = from.is_table() ? keys_of(*from.as_table()) : std::vector<std::string>{};
  throw InputError(path, fmt::format("the scene has no \"{}\" there{}", step.key,
                                     problems::suggestion(step.key, keys)));
}

void put(toml::node& parent, const Step& last, const toml::node& value, const std::string& path) {
  if (!last.is_place() && parent.is_table()) {
    value.visit([&](const auto& v) { parent.as_table()->insert_or_assign(last.key, v); });
    return;
  }
  if (!follow(parent, last)) fail_at(parent, last, path);
  toml::array& array = *parent.as_array();
  const auto place = array.cbegin() + static_cast<std::ptrdiff_t>(last.place);
  value.visit([&](const auto& v) { array.replace(place, v); });
}

void override_one(toml::table& scene, const std::string& text) {
  const std::size_t equals = text.find('=');
  problems::require(equals != std::string::npos && equals > 0, text, "expected KEY=VALUE");
  const std::string path = text.substr(0, equals);
  const toml::table value = read_value(text.substr(equals + 1), path);
  const std::vector<Step> steps = split(path);
  toml::node* parent = &scene;
  for (std::size_t i = 0; i + 1 < steps.size(); ++i) {
    toml::node* next = follow(*parent, steps[i]);
    if (!next && parent->is_table() && !steps[i].is_place() && !steps[i + 1].is_place()) {
      // A table that the scene leaves at its defaults; one that nobody knows is the parser's error.
      parent->as_table()->insert(steps[i].key, toml::table{});
      next = follow(*parent, steps[i]);
    }
    if (!next) fail_at(*parent, steps[i], path);
    parent = next;
  }
  put(*parent, steps.back(), *value.get("value"), path);
}

}  // namespace

SceneText with_overrides(const SceneText& scene, std::span<const std::string> overrides) {
  if (overrides.empty()) return scene;
  toml::table table = parse_toml(scene);
  for (const std::string& text : overrides) override_one(table, text);
  std::ostringstream out;
  out << toml::toml_formatter(table);
  return {scene.subject + " with other values", out.str()};
}

}  // namespace conebench::engine
