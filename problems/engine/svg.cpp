#include "problems/engine/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace conebench::engine {

// At nine equally spaced places (matplotlib's table, CC0), interpolated in between.
Colour viridis(double t) {
  static const std::array<Colour, 9> kTable = {
      Colour(68, 1, 84),    Colour(71, 45, 123),  Colour(59, 82, 139),
      Colour(44, 114, 142), Colour(33, 145, 140), Colour(40, 174, 128),
      Colour(94, 201, 98),  Colour(173, 220, 48), Colour(253, 231, 37)};
  const double place = std::clamp(t, 0.0, 1.0) * 8.0;
  const auto low = std::min<std::size_t>(7, static_cast<std::size_t>(place));
  const double share = place - static_cast<double>(low);
  return (1.0 - share) * kTable[low] + share * kTable[low + 1];
}

std::string hex(const Colour& colour) {
  return fmt::format("#{:02x}{:02x}{:02x}", std::lround(colour[0]), std::lround(colour[1]),
                     std::lround(colour[2]));
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) out += c == '<' ? "&lt;" : c == '&' ? "&amp;" : std::string(1, c);
  return out;
}

}  // namespace conebench::engine
