#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace conebench::dem {

/// The lines of a text that hold words, one at a time, for formats in which a line is a statement.
/// What stands behind a `#` is a remark. Errors: InputError naming the subject and the line.
class TextLines {
 public:
  TextLines(std::string_view text, std::string subject);

  /// Goes to the next line that holds a word; false at the end.
  bool next();

  const std::vector<std::string_view>& words() const { return words_; }
  /// Word k as a finite number; `what` says what it should have been.
  double number(std::size_t k, std::string_view what) const;

  [[noreturn]] void fail(const std::string& detail) const;

 private:
  std::string_view rest_;
  std::string subject_;
  std::vector<std::string_view> words_;
  int line_ = 0;
};

}  // namespace conebench::dem
