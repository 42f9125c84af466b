#include "harness/units.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <span>
#include <utility>

#include "problems/error.h"

namespace conebench::harness {
namespace {

using Unit = std::pair<std::string_view, double>;

constexpr Unit kDurations[] = {{"ns", 1e-9}, {"us", 1e-6},  {"ms", 1e-3},
                               {"s", 1.0},   {"min", 60.0}, {"h", 3600.0}};
constexpr Unit kSizes[] = {{"B", 1.0},      {"K", 0x1p10},   {"M", 0x1p20},   {"G", 0x1p30},
                           {"T", 0x1p40},   {"KiB", 0x1p10}, {"MiB", 0x1p20}, {"GiB", 0x1p30},
                           {"TiB", 0x1p40}, {"kB", 1e3},     {"MB", 1e6},     {"GB", 1e9},
                           {"TB", 1e12}};

std::string known(std::span<const Unit> units) {
  std::string names;
  for (const auto& [name, factor] : units) names += (names.empty() ? "" : ", ") + std::string(name);
  return names;
}

double parse(std::string_view text, std::string_view option, std::span<const Unit> units) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  problems::require(error == std::errc() && std::isfinite(value) && value > 0.0, option, "\"", text,
                    "\" is no positive number with a unit; known units: ", known(units));
  std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
  while (unit.starts_with(' ')) unit.remove_prefix(1);
  if (unit.empty()) return value;
  for (const auto& [name, factor] : units) {
    if (unit == name) return value * factor;
  }
  throw problems::InputError(
      option, fmt::format("\"{}\" has an unknown unit; known units: {}", text, known(units)));
}

}  // namespace

double parse_duration_s(std::string_view text, std::string_view option) {
  return parse(text, option, kDurations);
}

std::uint64_t parse_bytes(std::string_view text, std::string_view option) {
  const double bytes = parse(text, option, kSizes);
  problems::require(bytes >= 1.0 && bytes < 0x1p63, option, "\"", text,
                    "\" is not between 1 B and 8 EiB");
  return static_cast<std::uint64_t>(bytes);
}

std::string format_bytes(std::uint64_t bytes) {
  const double value = static_cast<double>(bytes);
  if (value >= 0x1p30) return fmt::format("{:.1f} GiB", value / 0x1p30);
  if (value >= 0x1p20) return fmt::format("{:.0f} MiB", value / 0x1p20);
  return fmt::format("{:.0f} KiB", value / 0x1p10);
}

}  // namespace conebench::harness
