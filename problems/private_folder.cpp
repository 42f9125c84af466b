#include "problems/private_folder.h"

#include <stdlib.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "problems/error.h"

namespace conebench::problems {

PrivateFolder::PrivateFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "conebench-XXXXXX").string();
  if (!::mkdtemp(name.data())) throw OutputError(name, std::strerror(errno));
  path_ = name;
}

PrivateFolder::~PrivateFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace conebench::problems
