#include "problems/engine/step_selection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <string>
#include <system_error>

#include "problems/error.h"
#include "problems/suggest.h"

namespace conebench::engine {
namespace {

// A whole number that fills the text, or nothing.
std::optional<std::int64_t> to_integer(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<StepSelection> parse_range(std::string_view text) {
  const auto dots = text.find("..");
  if (dots == std::string_view::npos) return std::nullopt;
  const auto first = to_integer(text.substr(0, dots));
  const auto last = to_integer(text.substr(dots + 2));
  if (!first || !last || *first < 0 || *first > *last) return std::nullopt;
  return StepSelection{.first = *first, .last = *last};
}

std::optional<StepSelection> parse_counted(std::string_view word, std::string_view number) {
  const auto count = to_integer(number);
  if (!count || *count < 1) return std::nullopt;
  if (word == "every") return StepSelection{.stride = *count};
  if (word == "hardest") return StepSelection{.sampling = Sampling::kHardest, .most = *count};
  if (word == "reservoir") return StepSelection{.sampling = Sampling::kReservoir, .most = *count};
  if (word == "stratified") return StepSelection{.sampling = Sampling::kStratified, .most = *count};
  return std::nullopt;
}

std::optional<StepSelection> parse(std::string_view text) {
  if (text == "all") return StepSelection{};
  const auto colon = text.find(':');
  if (colon == std::string_view::npos) return parse_range(text);
  return parse_counted(text.substr(0, colon), text.substr(colon + 1));
}

}  // namespace

StepSelection parse_selection(std::string_view text) {
  if (const auto selection = parse(text)) return *selection;
  static const std::array<std::string, 5> kWords = {"all", "every", "hardest", "reservoir",
                                                    "stratified"};
  const std::string word(text.substr(0, text.find(':')));
  const bool known = std::ranges::find(kWords, word) != kWords.end();
  throw problems::InputError(
      "policy", fmt::format("found \"{}\", expected all, every:N, hardest:K, reservoir:K, "
                            "stratified:K (N, K >= 1) or N..M (0 <= N <= M){}",
                            text, known ? "" : problems::suggestion(word, kWords)));
}

}  // namespace conebench::engine
