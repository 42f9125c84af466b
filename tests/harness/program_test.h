#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace conebench::harness {

struct Ran {
  int code = -1;
  std::string out, err;
  long error_lines() const { return std::count(err.begin(), err.end(), '\n'); }
};

inline std::string content(const std::filesystem::path& path) {
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// Runs the built program in an empty folder of its own.
class ProgramTest : public testing::Test {
 protected:
  ProgramTest()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("conebench-cli-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~ProgramTest() override { std::filesystem::remove_all(folder_); }

  /// Runs the built program in a shell; `before` may set limits.
  Ran conebench(const std::string& arguments, const std::string& before = "") const {
    const std::string command = before + " cd '" + folder_.string() +
                                "' && " CONEBENCH_PROGRAM " " + arguments + " > out.txt 2> err.txt";
    const int status = std::system(command.c_str());
    return {WEXITSTATUS(status), content(folder_ / "out.txt"), content(folder_ / "err.txt")};
  }

  void expect_usage_error(const std::string& arguments, const std::string& what) const {
    const Ran ran = conebench(arguments);
    EXPECT_EQ(ran.code, 2) << arguments << "\n" << ran.err;
    EXPECT_EQ(ran.error_lines(), 1) << ran.err;
    EXPECT_THAT(ran.err, testing::HasSubstr(what));
    EXPECT_EQ(ran.out, "");
  }

  std::filesystem::path folder_;
};

}  // namespace conebench::harness
