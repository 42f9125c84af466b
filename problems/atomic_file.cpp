#include "problems/atomic_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <utility>

#include "problems/error.h"

namespace conebench::problems {
namespace {

// A file of ours that is removed again unless it was renamed.
class Temporary {
 public:
  explicit Temporary(const std::filesystem::path& target) : target_(target) {
    static std::atomic<unsigned> count{0};
    path_ = target;
    path_.replace_filename("." + target.filename().string() + ".tmp-" + std::to_string(getpid()) +
                           "-" + std::to_string(count++));
    descriptor_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ < 0) fail("cannot create a file there");
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;

  ~Temporary() {
    if (descriptor_ >= 0) ::close(descriptor_);
    if (!path_.empty()) ::unlink(path_.c_str());
  }

  void write(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
      const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
      if (written < 0 && errno == EINTR) continue;
      if (written <= 0) fail("cannot write");
      bytes = bytes.subspan(static_cast<std::size_t>(written));
    }
  }

  void publish() {
    if (::fsync(descriptor_) != 0) fail("cannot sync");
    const int closed = ::close(std::exchange(descriptor_, -1));
    if (closed != 0) fail("cannot close");
    if (::rename(path_.c_str(), target_.c_str()) != 0) fail("cannot rename the new file to it");
    path_.clear();
    sync_folder(target_.has_parent_path() ? target_.parent_path() : ".");
  }

 private:
  [[noreturn]] void fail(const char* what) {
    const int reason = errno;
    // The constructor's failure runs no destructor, but then there is no file either.
    throw OutputError(target_.string(), std::string(what) + ": " + std::strerror(reason));
  }

  std::filesystem::path target_, path_;
  int descriptor_ = -1;
};

}  // namespace

void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  Temporary file(path);
  file.write(bytes);
  file.publish();
}

void sync_file(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!synced)
    throw OutputError(path.string(), std::string("cannot sync: ") + std::strerror(reason));
}

// Some file systems refuse to sync a folder; the files are safe.
void sync_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace conebench::problems
