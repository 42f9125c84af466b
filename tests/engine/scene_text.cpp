#include "tests/engine/scene_text.h"

#include <gtest/gtest.h>

#include "problems/error.h"

namespace conebench::test {

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

std::string input_error(const std::string& subject, const std::function<void()>& read) {
  try {
    read();
  } catch (const problems::InputError& error) {
    EXPECT_EQ(error.subject(), subject);
    return error.what();
  }
  return "no error";
}

}  // namespace conebench::test
