#include "results/line_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <thread>

#include "problems/error.h"
#include "results/output.h"

namespace conebench::results {
namespace {

using problems::OutputError;

constexpr int kLockAttempts = 20;
constexpr std::chrono::milliseconds kLockPause{25};

std::string reason() { return std::generic_category().message(errno); }

bool ends_torn(int fd) {
  const off_t size = ::lseek(fd, 0, SEEK_END);
  char last = '\n';
  return size > 0 && ::pread(fd, &last, 1, size - 1) == 1 && last != '\n';
}

// A campaign that was just killed may leave a worker for an instant, and with it the lock.
bool lock(int fd) {
  for (int attempt = 0; attempt < kLockAttempts; ++attempt) {
    if (::flock(fd, LOCK_EX | LOCK_NB) == 0) return true;
    std::this_thread::sleep_for(kLockPause);
  }
  return false;
}

}  // namespace

LineFile::LineFile(const std::filesystem::path& path) : path_(path) {
  if (path.has_parent_path()) make_folder(path.parent_path());
  fd_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (fd_ < 0) throw OutputError(path.string(), reason());
  try {
    if (!lock(fd_)) throw OutputError(path.string(), "another run is writing to it");
    if (ends_torn(fd_)) write("\n");
  } catch (...) {
    ::close(fd_);
    throw;
  }
}

LineFile::~LineFile() {
  if (unsynced_) ::fdatasync(fd_);
  ::close(fd_);
}

void LineFile::append(std::string_view lines) {
  write(lines);
  flush_if_due();
}

void LineFile::flush_if_due() {
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - waiting_since_;
  if (waited.count() >= kGroup_s) flush();
}

void LineFile::write(std::string_view lines) {
  const off_t before = ::lseek(fd_, 0, SEEK_END);
  std::string_view left = lines;
  bool ok = true;
  while (ok && !left.empty()) {
    const ssize_t done = ::write(fd_, left.data(), left.size());
    if (done > 0) left.remove_prefix(static_cast<std::size_t>(done));
    ok = done > 0 || (done < 0 && errno == EINTR);
  }
  if (ok) {
    if (!unsynced_) waiting_since_ = std::chrono::steady_clock::now();
    unsynced_ = true;
    return;
  }
  const std::string why = reason();
  // If this fails too, readers ignore the torn line.
  if (::ftruncate(fd_, before) != 0) throw OutputError(path_.string(), why + " (torn line left)");
  throw OutputError(path_.string(), why);
}

void LineFile::flush() {
  if (!unsynced_) return;
  if (::fdatasync(fd_) != 0) throw OutputError(path_.string(), reason());
  unsynced_ = false;
}

}  // namespace conebench::results
