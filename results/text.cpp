#include "results/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace conebench::results {
namespace {

// Code points, which is what a terminal shows of the few non-ASCII characters in use here.
std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string three_digits(double value) {
  const int decimals = value < 9.995 ? 2 : value < 99.95 ? 1 : 0;
  return fmt::format("{:.{}f}", value, decimals);
}

}  // namespace

std::string format_time(double time_s) {
  if (!std::isfinite(time_s)) return "-";
  if (time_s < 0.9995e-3) return three_digits(time_s * 1e6) + " us";
  if (time_s < 0.9995) return three_digits(time_s * 1e3) + " ms";
  return three_digits(time_s) + " s";
}

std::string format_eta(double eta) { return std::isfinite(eta) ? fmt::format("{:.1e}", eta) : "-"; }

std::string tick(const std::string& name) { return "`" + name + "`"; }

TextTable::TextTable(std::vector<std::string> header) { rows_.push_back(std::move(header)); }

void TextTable::add(std::vector<std::string> row) { rows_.push_back(std::move(row)); }

std::string TextTable::text() const {
  std::vector<std::size_t> widths(rows_.front().size(), 3);
  for (const auto& row : rows_) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
  }
  std::string text;
  for (std::size_t r = 0; r < rows_.size(); ++r) {
    for (std::size_t c = 0; c < widths.size(); ++c) {
      const std::string padding(widths[c] - width(rows_[r][c]), ' ');
      text += c == 0 ? "| " + rows_[r][c] + padding : " | " + padding + rows_[r][c];
    }
    text += " |\n";
    if (r > 0) continue;
    for (std::size_t c = 0; c < widths.size(); ++c) {
      text += "|" + std::string(widths[c] + 1, '-') + (c == 0 ? "-" : ":");
    }
    text += "|\n";
  }
  return text;
}

}  // namespace conebench::results
