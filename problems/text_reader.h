#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

namespace conebench::problems {

/// Words of a text file, separated by white space, with line numbers for messages. The file is
/// held in memory and must end with a line end, or it may have been cut. Every failure is an
/// InputError naming file and line.
class TextReader {
 public:
  explicit TextReader(const std::filesystem::path& path);

  const std::string& subject() const { return subject_; }

  bool at_end();
  /// The next word; `what` says what it should have been.
  std::string_view word(std::string_view what);
  void expect(std::string_view word);
  int integer(std::string_view what, int low, int high);
  /// As integer(), >= 0, but a comma may follow in the same word.
  int leading_integer(std::string_view what);
  double number(std::string_view what);
  std::vector<int> integers(std::string_view what, int count, int low, int high);
  Eigen::VectorXd numbers(std::string_view what, int count);
  /// Refuses a claim of more numbers than the rest of the file can hold, before memory is taken.
  void require_room(std::string_view what, std::int64_t count) const;
  /// Drops what is left of the current line.
  void skip_line();

  [[noreturn]] void fail(const std::string& detail) const;

 private:
  void skip_space();

  std::string subject_, text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

}  // namespace conebench::problems
