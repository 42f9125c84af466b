#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace conebench::engine {

/// A hidden folder FOLDER/.<scene>.provisional for problem files that may yet be dropped and whose
/// weight is not known. It goes with this object; a process that is killed leaves it, and the next
/// one for the same scene and folder clears it. Whoever looks for problems passes over it.
///
/// Errors: InputError when another process is at work in it; OutputError.
class ProvisionalFolder {
 public:
  /// A file of it, and how many steps the problem stands for.
  struct Entry {
    std::string name;
    double weight = 1.0;
  };

  /// `folder` must be there.
  ProvisionalFolder(const std::filesystem::path& folder, std::string_view scene);
  ~ProvisionalFolder();
  ProvisionalFolder(const ProvisionalFolder&) = delete;
  ProvisionalFolder& operator=(const ProvisionalFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Removes a file of it.
  void drop(const std::string& name) const;
  /// Gives the files their weights and then moves all of them to the folder, in place of any of the
  /// same names.
  void publish(std::span<const Entry> entries) const;

 private:
  std::filesystem::path folder_, path_;
  int lock_ = -1;
};

}  // namespace conebench::engine
