#pragma once

#include <functional>
#include <string>

#include "results/record.h"

namespace conebench::harness {

/// A way in which a run fails, to be recognised in other runs.
class Failure {
 public:
  /// `text`, what the user calls a failure:
  ///   empty                how `run` ended; it must not have solved its problem
  ///   a status             results::to_string(), with eta above the tolerance
  ///   a condition          on status, claimed, solved, eta, iterations and time (s); see
  ///                        harness/condition.h. What has no eta has an infinite one
  /// Throws InputError where the text is none of them, and where `run` does not fail so.
  Failure(const std::string& text, const results::Record& run);

  bool seen_in(const results::Record& record) const { return matches_(record); }

  /// "stalled", "eta > 1e-3".
  const std::string& text() const { return text_; }

 private:
  std::string text_;
  std::function<bool(const results::Record&)> matches_;
};

/// "stalled, eta 3.2e-04", "crashed: SIGSEGV ...".
std::string describe_run(const results::Record& record);

}  // namespace conebench::harness
