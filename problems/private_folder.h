#pragma once

#include <filesystem>

namespace conebench::problems {

/// An empty folder among the system's temporary ones that nobody else may read; it goes, with what
/// is in it, when this does. Throws OutputError.
class PrivateFolder {
 public:
  PrivateFolder();
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace conebench::problems
