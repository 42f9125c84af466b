#include "problems/text_reader.h"

#include <charconv>
#include <cmath>
#include <fstream>

#include "problems/error.h"

namespace conebench::problems {
namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

template <class Number>
bool parse(std::string_view word, Number& value) {
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

}  // namespace

TextReader::TextReader(const std::filesystem::path& path) : subject_(path.string()) {
  std::ifstream in(path, std::ios::binary);
  require(in.is_open(), subject_, "cannot be opened for reading");
  text_.assign(std::istreambuf_iterator<char>(in), {});
  require(!in.bad(), subject_, "cannot be read");
  require(text_.empty() || is_space(text_.back()), subject_,
          "ends in the middle of a line, expected a whole file");
}

void TextReader::fail(const std::string& detail) const {
  throw InputError(subject_, "line " + std::to_string(line_) + ": " + detail);
}

void TextReader::skip_space() {
  for (; at_ < text_.size() && is_space(text_[at_]); ++at_) {
    if (text_[at_] == '\n') ++line_;
  }
}

bool TextReader::at_end() {
  skip_space();
  return at_ == text_.size();
}

std::string_view TextReader::word(std::string_view what) {
  skip_space();
  if (at_ == text_.size()) fail("the file ends, expected " + std::string(what));
  const std::size_t first = at_;
  while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
  return std::string_view(text_).substr(first, at_ - first);
}

void TextReader::expect(std::string_view wanted) {
  const std::string_view found = word(wanted);
  if (found != wanted) {
    fail("found '" + std::string(found.substr(0, 40)) + "', expected '" + std::string(wanted) +
         "'");
  }
}

int TextReader::integer(std::string_view what, int low, int high) {
  const std::string_view found = word(what);
  int value = 0;
  if (!parse(found, value) || value < low || value > high) {
    fail("found '" + std::string(found.substr(0, 40)) + "', expected " + std::string(what) + ", " +
         std::to_string(low) + " to " + std::to_string(high));
  }
  return value;
}

int TextReader::leading_integer(std::string_view what) {
  std::string_view found = word(what);
  if (found.ends_with(',')) found.remove_suffix(1);
  int value = 0;
  if (!parse(found, value) || value < 0) {
    fail("found '" + std::string(found.substr(0, 40)) + "', expected " + std::string(what));
  }
  return value;
}

double TextReader::number(std::string_view what) {
  const std::string_view found = word(what);
  double value = 0.0;
  if (!parse(found, value) || !std::isfinite(value)) {
    fail("found '" + std::string(found.substr(0, 40)) + "', expected " + std::string(what) +
         ", a finite number");
  }
  return value;
}

// A number takes at least one character and a separator.
void TextReader::require_room(std::string_view what, std::int64_t count) const {
  const auto left = static_cast<std::int64_t>(text_.size() - at_);
  if (count > left / 2 + 1) {
    fail("the file is too short for " + std::to_string(count) + " of " + std::string(what));
  }
}

std::vector<int> TextReader::integers(std::string_view what, int count, int low, int high) {
  require_room(what, count);
  std::vector<int> values;
  values.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) values.push_back(integer(what, low, high));
  return values;
}

Eigen::VectorXd TextReader::numbers(std::string_view what, int count) {
  require_room(what, count);
  Eigen::VectorXd values(count);
  for (double& value : values) value = number(what);
  return values;
}

void TextReader::skip_line() {
  while (at_ < text_.size() && text_[at_] != '\n') ++at_;
}

}  // namespace conebench::problems
