#include "problems/engine/toml_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "problems/error.h"
#include "problems/suggest.h"

namespace conebench::engine {
namespace {

using problems::InputError;

std::string_view type_in_words(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
      return "an integer";
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

std::string_view in_words(Range range) {
  switch (range) {
    case Range::kAny:
      return "a finite number";
    case Range::kNotNegative:
      return "a number >= 0";
    case Range::kPositive:
      return "a number > 0";
    case Range::kUnitInterval:
      return "a number in [0, 1]";
    case Range::kPositiveShare:
      return "a number in (0, 1]";
  }
  return {};
}

bool contains(Range range, double value) {
  if (!std::isfinite(value)) return false;
  switch (range) {
    case Range::kAny:
      return true;
    case Range::kNotNegative:
      return value >= 0.0;
    case Range::kPositive:
      return value > 0.0;
    case Range::kUnitInterval:
      return value >= 0.0 && value <= 1.0;
    case Range::kPositiveShare:
      return value > 0.0 && value <= 1.0;
  }
  return false;
}

std::string integer_in_words(std::int64_t low) { return fmt::format("an integer >= {}", low); }
std::string numbers_in_words(std::size_t count) {
  return fmt::format("an array of {} numbers", count);
}

std::string found_expected(std::string_view found, std::string_view expected) {
  return fmt::format("found {}, expected {}", found, expected);
}

}  // namespace

TomlReader::TomlReader(const toml::table& table, std::string path, std::string subject)
    : table_(&table), path_(std::move(path)), subject_(std::move(subject)) {}

void TomlReader::fail(std::string_view key, std::string_view detail) const {
  const toml::node* node = table_->get(key);
  const auto line = node ? node->source().begin.line : table_->source().begin.line;
  throw InputError(subject_, fmt::format("line {}: {}{}: {}", line, path_, key, detail));
}

const toml::node* TomlReader::find(std::string_view key) {
  known_.emplace_back(key);
  return table_->get(key);
}

const toml::node& TomlReader::need(std::string_view key, std::string_view expected) {
  const toml::node* node = find(key);
  if (!node) fail(key, fmt::format("missing, expected {}", expected));
  return *node;
}

double TomlReader::to_number(const toml::node& node, std::string_view key, Range range) const {
  if (!node.is_number()) fail(key, found_expected(type_in_words(node), in_words(range)));
  const double value = *node.value<double>();
  if (!contains(range, value)) fail(key, found_expected(fmt::format("{}", value), in_words(range)));
  return value + 0.0;  // -0.0 becomes 0.0: printed as "-0" it would read back as the integer 0
}

std::int64_t TomlReader::to_integer(const toml::node& node, std::string_view key,
                                    std::int64_t low) const {
  const std::string expected = integer_in_words(low);
  if (!node.is_integer()) fail(key, found_expected(type_in_words(node), expected));
  const std::int64_t value = *node.value<std::int64_t>();
  if (value < low) fail(key, found_expected(fmt::format("{}", value), expected));
  return value;
}

std::vector<double> TomlReader::to_numbers(const toml::node& node, std::string_view key,
                                           std::size_t count, Range range) const {
  const toml::array* array = node.as_array();
  const std::string expected = numbers_in_words(count);
  if (!array) fail(key, found_expected(type_in_words(node), expected));
  if (array->size() != count) {
    fail(key, found_expected(fmt::format("an array of {}", array->size()), expected));
  }
  std::vector<double> values;
  for (const toml::node& entry : *array) values.push_back(to_number(entry, key, range));
  return values;
}

double TomlReader::number(std::string_view key, Range range, std::optional<double> fallback) {
  if (fallback) {
    const toml::node* node = find(key);
    return node ? to_number(*node, key, range) : *fallback;
  }
  return to_number(need(key, in_words(range)), key, range);
}

std::int64_t TomlReader::integer(std::string_view key, std::int64_t low,
                                 std::optional<std::int64_t> fallback) {
  const toml::node* node = fallback ? find(key) : &need(key, integer_in_words(low));
  return node ? to_integer(*node, key, low) : *fallback;
}

bool TomlReader::boolean(std::string_view key, bool fallback) {
  const toml::node* node = find(key);
  if (!node) return fallback;
  if (!node->is_boolean()) fail(key, found_expected(type_in_words(*node), "true or false"));
  return *node->value<bool>();
}

std::string TomlReader::text(std::string_view key, std::optional<std::string> fallback) {
  const toml::node* node = fallback ? find(key) : &need(key, "a string");
  if (!node) return *fallback;
  if (!node->is_string()) fail(key, found_expected(type_in_words(*node), "a string"));
  return *node->value<std::string>();
}

Eigen::Vector3d TomlReader::vector(std::string_view key, std::optional<Eigen::Vector3d> fallback) {
  const toml::node* node = fallback ? find(key) : &need(key, numbers_in_words(3));
  if (!node) return *fallback;
  const std::vector<double> values = to_numbers(*node, key, 3, Range::kAny);
  return {values[0], values[1], values[2]};
}

std::vector<double> TomlReader::numbers(std::string_view key, std::size_t count, Range range,
                                        std::optional<std::vector<double>> fallback) {
  const toml::node* node = fallback ? find(key) : &need(key, numbers_in_words(count));
  return node ? to_numbers(*node, key, count, range) : *fallback;
}

Eigen::Vector2d TomlReader::interval(std::string_view key, Range range) {
  const std::vector<double> values = numbers(key, 2, range);
  if (values[0] > values[1]) {
    fail(key, fmt::format("found [{}, {}], expected the smaller first", values[0], values[1]));
  }
  return {values[0], values[1]};
}

std::vector<std::int64_t> TomlReader::integers(std::string_view key, std::size_t least,
                                               std::size_t most, std::int64_t low) {
  const std::string expected = fmt::format("an array of {} to {} integers >= {}", least, most, low);
  const toml::node& node = need(key, expected);
  const toml::array* array = node.as_array();
  if (!array) fail(key, found_expected(type_in_words(node), expected));
  if (array->size() < least || array->size() > most) {
    fail(key, found_expected(fmt::format("an array of {}", array->size()), expected));
  }
  std::vector<std::int64_t> values;
  for (const toml::node& entry : *array) values.push_back(to_integer(entry, key, low));
  return values;
}

std::size_t TomlReader::word(std::string_view key, std::span<const std::string> words,
                             std::optional<std::string> fallback) {
  const std::string expected = fmt::format("one of \"{}\"", fmt::join(words, "\", \""));
  const toml::node* node = fallback ? find(key) : &need(key, expected);
  if (node && !node->is_string()) fail(key, found_expected(type_in_words(*node), expected));
  const std::string found = node ? *node->value<std::string>() : *fallback;
  const auto at = std::find(words.begin(), words.end(), found);
  if (at == words.end()) {
    fail(key, found_expected(fmt::format("\"{}\"", found), expected) +
                  problems::suggestion(found, words));
  }
  return static_cast<std::size_t>(at - words.begin());
}

std::vector<std::string> TomlReader::texts(std::string_view key, std::size_t count) {
  const std::string expected = fmt::format("an array of {} strings", count);
  const toml::node& node = need(key, expected);
  const toml::array* array = node.as_array();
  if (!array || array->size() != count) fail(key, found_expected(type_in_words(node), expected));
  std::vector<std::string> values;
  for (const toml::node& entry : *array) {
    if (!entry.is_string()) fail(key, found_expected(type_in_words(entry), "a string"));
    values.push_back(*entry.value<std::string>());
  }
  return values;
}

const toml::array& TomlReader::need_some(std::string_view key, std::string_view of) {
  const std::string expected = fmt::format("an array of one or more {}", of);
  const toml::node& node = need(key, expected);
  const toml::array* array = node.as_array();
  if (!array) fail(key, found_expected(type_in_words(node), expected));
  if (array->empty()) fail(key, found_expected("an empty array", expected));
  return *array;
}

std::vector<std::string> TomlReader::some_texts(std::string_view key) {
  return texts(key, need_some(key, "strings").size());
}

std::vector<double> TomlReader::some_numbers(std::string_view key, Range range) {
  return numbers(key, need_some(key, "numbers").size(), range);
}

std::vector<Eigen::Vector3d> TomlReader::some_vectors(std::string_view key) {
  std::vector<Eigen::Vector3d> values;
  for (const toml::node& entry : need_some(key, "arrays of 3 numbers")) {
    const std::vector<double> x = to_numbers(entry, key, 3, Range::kAny);
    values.emplace_back(x[0], x[1], x[2]);
  }
  return values;
}

std::vector<Eigen::Vector3i> TomlReader::some_triples(std::string_view key, std::int64_t low) {
  const std::string expected = "arrays of 3 integers";
  std::vector<Eigen::Vector3i> values;
  for (const toml::node& entry : need_some(key, expected)) {
    const toml::array* array = entry.as_array();
    if (!array || array->size() != 3) fail(key, found_expected(type_in_words(entry), expected));
    Eigen::Vector3i triple;
    for (int k = 0; k < 3; ++k) {
      triple[k] = static_cast<int>(to_integer((*array)[static_cast<std::size_t>(k)], key, low));
    }
    values.push_back(triple);
  }
  return values;
}

std::optional<TomlReader> TomlReader::table(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return std::nullopt;
  if (!node->is_table()) fail(key, found_expected(type_in_words(*node), "a table"));
  return TomlReader(*node->as_table(), fmt::format("{}{}.", path_, key), subject_);
}

std::vector<TomlReader> TomlReader::tables(std::string_view key) {
  const toml::node* node = find(key);
  if (!node) return {};
  const toml::array* array = node->as_array();
  if (!array) fail(key, found_expected(type_in_words(*node), "an array of tables"));
  std::vector<TomlReader> readers;
  for (const toml::node& entry : *array) {
    if (!entry.is_table()) fail(key, found_expected(type_in_words(entry), "a table"));
    readers.emplace_back(*entry.as_table(), fmt::format("{}{}[{}].", path_, key, readers.size()),
                         subject_);
  }
  return readers;
}

void TomlReader::finish() const {
  for (const auto& [key, node] : *table_) {
    if (std::find(known_.begin(), known_.end(), key.str()) != known_.end()) continue;
    throw InputError(subject_,
                     fmt::format("line {}: {}{}: unknown key{}", node.source().begin.line, path_,
                                 key.str(), problems::suggestion(key.str(), known_)));
  }
}

}  // namespace conebench::engine
