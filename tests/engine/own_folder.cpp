#include "tests/engine/own_folder.h"

#include <algorithm>
#include <iterator>

namespace conebench::test {

namespace fs = std::filesystem;

OwnFolder::OwnFolder() {
  const auto* info = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string("conebench-") + info->test_suite_name() + "-" + info->name();
  std::replace(name.begin(), name.end(), '/', '-');
  folder_ = fs::temp_directory_path() / name;
  fs::remove_all(folder_);
}

OwnFolder::~OwnFolder() { fs::remove_all(folder_); }

std::size_t OwnFolder::count() const {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
}

}  // namespace conebench::test
