#pragma once

#include <chrono>
#include <filesystem>
#include <string_view>

namespace conebench::results {

/// A text file that only grows, by whole lines. Lines are with the system when append() returns, so
/// that no kill of this process can lose them. They are on disk within kFlush_s if flush_if_due()
/// is called every kAsk_s, so that a power loss costs at most the last kFlush_s. Lines that come
/// within kGroup_s share one sync. Holds a lock, so that two processes never write to one file.
class LineFile {
 public:
  static constexpr double kFlush_s = 0.1;
  static constexpr double kGroup_s = 0.5 * kFlush_s;  ///< the rest is for asking late, and the sync
  static constexpr double kAsk_s = 0.25 * kFlush_s;

  /// Opens or creates the file and its folder; terminates a torn last line. Throws
  /// problems::OutputError when the place is not writable or another process holds the lock.
  explicit LineFile(const std::filesystem::path& path);
  ~LineFile();  ///< flushes
  LineFile(const LineFile&) = delete;
  LineFile& operator=(const LineFile&) = delete;

  /// Lines with their ends: all of them or, with problems::OutputError (disk full), none.
  void append(std::string_view lines);
  /// Syncs to disk what has waited for kGroup_s. Throws problems::OutputError.
  void flush_if_due();
  /// Syncs to disk what has not been. Throws problems::OutputError.
  void flush();

 private:
  void write(std::string_view lines);

  std::filesystem::path path_;
  int fd_ = -1;
  bool unsynced_ = false;
  std::chrono::steady_clock::time_point waiting_since_{};
};

}  // namespace conebench::results
