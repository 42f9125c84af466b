#include "problems/engine/step_selection.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <system_error>

#include "problems/error.h"

namespace conebench::engine {
namespace {

// A whole number that fills the text, or nothing.
std::optional<std::int64_t> to_integer(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return value;
}

}  // namespace

StepSelection parse_selection(std::string_view text) {
  StepSelection selection;
  if (text == "all") return selection;
  if (text.starts_with("every:")) {
    const auto stride = to_integer(text.substr(6));
    if (stride && *stride >= 1) return {0, selection.last, *stride};
  }
  if (const auto dots = text.find(".."); dots != std::string_view::npos) {
    const auto first = to_integer(text.substr(0, dots));
    const auto last = to_integer(text.substr(dots + 2));
    if (first && last && *first >= 0 && *first <= *last) return {*first, *last, 1};
  }
  throw problems::InputError("policy", fmt::format("found \"{}\", expected all, every:N (N >= 1) "
                                                   "or N..M (0 <= N <= M)",
                                                   text));
}

}  // namespace conebench::engine
