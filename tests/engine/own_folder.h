#pragma once

#include <gtest/gtest.h>

#include <filesystem>

namespace conebench::test {

/// A test with a folder of its own: not there when the test starts, removed when it ends.
class OwnFolder : public testing::Test {
 protected:
  OwnFolder();
  ~OwnFolder() override;

  /// Files and folders in it.
  std::size_t count() const;

  std::filesystem::path folder_;
};

}  // namespace conebench::test
