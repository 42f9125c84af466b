#pragma once

#include <functional>
#include <string>

namespace conebench::test {

/// `text` with the first `from` replaced by `to`; a failure where there is none.
std::string changed(std::string text, const std::string& from, const std::string& to);

/// What `read` complains of, about `subject`, or "no error".
std::string input_error(const std::string& subject, const std::function<void()>& read);

}  // namespace conebench::test
