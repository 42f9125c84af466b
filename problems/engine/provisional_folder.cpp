#include "problems/engine/provisional_folder.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

#include "problems/atomic_file.h"
#include "problems/engine/text_file.h"
#include "problems/error.h"
#include "problems/problem_file.h"

namespace conebench::engine {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLockName = "lock";

// A lock that ends with the process, however that ends.
int lock_folder(const fs::path& path) {
  const int descriptor = ::open((path / kLockName).c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
  if (descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) return descriptor;
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (descriptor >= 0 && reason == EWOULDBLOCK) {
    throw problems::InputError(path.string(),
                               "another run exports the same scene to the same folder, expected "
                               "its end or another folder");
  }
  throw problems::OutputError(path.string(), std::string("cannot lock: ") + std::strerror(reason));
}

void clear_all_but_lock(const fs::path& path) {
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(path, error)) {
    if (entry.path().filename() != kLockName) fs::remove_all(entry.path(), error);
    if (error) break;
  }
  if (error) throw problems::OutputError(path.string(), "cannot clear: " + error.message());
}

void move_file(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::rename(from, to, error);
  if (error) throw problems::OutputError(to.string(), "cannot rename to it: " + error.message());
}

}  // namespace

ProvisionalFolder::ProvisionalFolder(const fs::path& folder, std::string_view scene)
    : folder_(folder), path_(folder / fmt::format(".{}.provisional", scene)) {
  make_folder(path_);
  lock_ = lock_folder(path_);
  clear_all_but_lock(path_);
}

ProvisionalFolder::~ProvisionalFolder() {
  std::error_code ignored;  // what cannot be removed is cleared by the next run
  fs::remove_all(path_, ignored);
  ::close(lock_);
}

void ProvisionalFolder::drop(const std::string& name) const {
  std::error_code error;
  fs::remove(path_ / name, error);
  if (error) throw problems::OutputError((path_ / name).string(), error.message());
}

void ProvisionalFolder::publish(std::span<const Entry> entries) const {
  for (const Entry& entry : entries) {
    problems::set_sampling_weight(path_ / entry.name, entry.weight);
  }
  for (const Entry& entry : entries) move_file(path_ / entry.name, folder_ / entry.name);
  problems::sync_folder(folder_);
}

}  // namespace conebench::engine
