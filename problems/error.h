#pragma once

#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace conebench::problems {

/// Input that no part of the program can use: a malformed problem, file, scene or setting.
/// A solver that does not converge is not an error; see solvers::Status.
class InputError : public std::invalid_argument {
 public:
  InputError(std::string_view subject, std::string_view detail)
      : std::invalid_argument(std::string(subject) + ": " + std::string(detail)),
        subject_(subject) {}

  /// What was rejected, e.g. a problem name or a file; the program writes it to its records.
  const std::string& subject() const noexcept { return subject_; }

 private:
  std::string subject_;
};

/// Something outside the input failed: an unwritable folder, a full disk.
class OutputError : public std::runtime_error {
 public:
  OutputError(std::string_view subject, std::string_view detail)
      : std::runtime_error(std::string(subject) + ": " + std::string(detail)) {}
};

/// Throws InputError unless `ok`. Say what was found, then what was expected:
///   require(q.size() == n, name, "q has ", q.size(), " entries, W has ", n, " rows");
template <class... Parts>
void require(bool ok, std::string_view subject, const Parts&... detail) {
  if (ok) return;
  std::ostringstream text;
  text.precision(6);
  (text << ... << detail);
  throw InputError(subject, text.str());
}

}  // namespace conebench::problems
