#include "dem/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "problems/error.h"

namespace conebench::dem {
namespace {

constexpr std::string_view kSpace = " \t\r\v\f";

// All of the word, which may begin with a plus sign.
bool parse(std::string_view word, double& value) {
  if (word.starts_with('+') && !word.starts_with("+-")) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

TextLines::TextLines(std::string_view text, std::string subject)
    : rest_(text), subject_(std::move(subject)) {}

bool TextLines::next() {
  words_.clear();
  while (words_.empty() && !rest_.empty()) {
    ++line_;
    std::string_view line = rest_.substr(0, rest_.find('\n'));
    rest_.remove_prefix(std::min(line.size() + 1, rest_.size()));
    line = line.substr(0, line.find('#'));
    for (std::size_t at = line.find_first_not_of(kSpace); at != line.npos;) {
      const std::size_t end = std::min(line.find_first_of(kSpace, at), line.size());
      words_.push_back(line.substr(at, end - at));
      at = line.find_first_not_of(kSpace, end);
    }
  }
  return !words_.empty();
}

double TextLines::number(std::size_t k, std::string_view what) const {
  const std::string wanted = std::string(what) + ", a finite number";
  if (k >= words_.size()) fail("the line ends, expected " + wanted);
  double value = 0.0;
  if (!parse(words_[k], value) || !std::isfinite(value)) {
    fail("found '" + std::string(words_[k].substr(0, 40)) + "', expected " + wanted);
  }
  return value;
}

void TextLines::fail(const std::string& detail) const {
  throw problems::InputError(subject_, "line " + std::to_string(line_) + ": " + detail);
}

}  // namespace conebench::dem
