#pragma once

#include <toml++/toml.h>
#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace conebench::engine {

/// What a number may be; said in words in the error.
enum class Range { kAny, kNotNegative, kPositive, kUnitInterval, kPositiveShare };

/// One TOML table, read key by key. Every key asked for is remembered, so that finish() can name
/// those that nobody knows. Internal to the scene parsers.
///
/// Errors: InputError "<subject>: line 7: materials[0].density_kg_m3: found -3, expected > 0".
class TomlReader {
 public:
  /// `path` is the prefix of key names in errors: "" or "materials[0].".
  TomlReader(const toml::table& table, std::string path, std::string subject);

  /// Without a fallback the key is required.
  double number(std::string_view key, Range range, std::optional<double> fallback = {});
  std::int64_t integer(std::string_view key, std::int64_t low,
                       std::optional<std::int64_t> fallback = {});
  bool boolean(std::string_view key, bool fallback);
  std::string text(std::string_view key, std::optional<std::string> fallback = {});
  Eigen::Vector3d vector(std::string_view key, std::optional<Eigen::Vector3d> fallback = {});
  std::vector<double> numbers(std::string_view key, std::size_t count, Range range,
                              std::optional<std::vector<double>> fallback = {});
  Eigen::Vector2d interval(std::string_view key, Range range);
  std::vector<std::string> texts(std::string_view key, std::size_t count);

  /// Arrays of any length, at least one.
  std::vector<std::string> some_texts(std::string_view key);
  std::vector<double> some_numbers(std::string_view key, Range range);

  /// Arrays of three numbers, or of three integers >= low, at least one.
  std::vector<Eigen::Vector3d> some_vectors(std::string_view key);
  std::vector<Eigen::Vector3i> some_triples(std::string_view key, std::int64_t low);

  /// From `least` to `most` integers, each >= low.
  std::vector<std::int64_t> integers(std::string_view key, std::size_t least, std::size_t most,
                                     std::int64_t low);

  /// The place among `words` of the one that is there. Errors suggest the nearest word.
  std::size_t word(std::string_view key, std::span<const std::string> words,
                   std::optional<std::string> fallback = {});

  bool has(std::string_view key) const { return table_->contains(key); }
  bool has_table(std::string_view key) const { return table_->get_as<toml::table>(key); }

  /// The sub-table, or nothing; and the elements of an array of tables, possibly none.
  std::optional<TomlReader> table(std::string_view key);
  std::vector<TomlReader> tables(std::string_view key);

  /// Throws unless every key of the table has been asked for.
  void finish() const;

  /// Throws an InputError about `key`.
  [[noreturn]] void fail(std::string_view key, std::string_view detail) const;

 private:
  const toml::array& need_some(std::string_view key, std::string_view of);
  const toml::node* find(std::string_view key);
  const toml::node& need(std::string_view key, std::string_view expected);
  double to_number(const toml::node& node, std::string_view key, Range range) const;
  std::int64_t to_integer(const toml::node& node, std::string_view key, std::int64_t low) const;
  std::vector<double> to_numbers(const toml::node& node, std::string_view key, std::size_t count,
                                 Range range) const;

  const toml::table* table_;
  std::string path_, subject_;
  std::vector<std::string> known_;
};

}  // namespace conebench::engine
