#pragma once

#include <chrono>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "results/record.h"

namespace conebench::results {

/// One part of a campaign, of `count`; the whole of it is 1 of 1.
struct Shard {
  int index = 1;  ///< 1 to count
  int count = 1;
};

/// RESULTS_DIR/journal.jsonl; of a shard RESULTS_DIR/journal-3-of-20.jsonl.
std::filesystem::path journal_path(const std::filesystem::path& results_dir, Shard shard = {});

/// What journals hold. A line counts if it is one complete record: a line that a kill or a power
/// loss has cut short does not, and its task is simply not done yet. Likewise the records of a
/// sequence count only if all of them are there.
struct JournalContent {
  std::vector<Record> records;  ///< in the order written; of a task that ran twice, only the last
  int torn_lines = 0;           ///< lines that do not count
};

/// A journal that does not exist is empty. Throws problems::InputError when it cannot be read.
JournalContent read_journal(const std::filesystem::path& path);

/// The journals of all shards in a folder, in alphabetical order; of a task that two of them hold,
/// the later record.
JournalContent read_results(const std::filesystem::path& results_dir);

/// Appends records to a journal, one JSON line each. A record is with the system when append()
/// returns, so that no kill of this process can lose it. It is on disk within kFlush_s if
/// flush_if_due() is called every kAsk_s, so that a power loss costs at most the last kFlush_s.
/// Records that come within kGroup_s share one sync. Holds a lock, so that two campaigns never
/// write to one journal.
class Journal {
 public:
  static constexpr double kFlush_s = 0.1;
  static constexpr double kGroup_s = 0.5 * kFlush_s;  ///< the rest is for asking late, and the sync
  static constexpr double kAsk_s = 0.25 * kFlush_s;

  /// Opens or creates the journal; terminates a torn last line. Throws problems::OutputError when
  /// the place is not writable or another process holds the lock.
  explicit Journal(const std::filesystem::path& path);
  ~Journal();  ///< flushes
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// The records of one task: all of their lines or, with problems::OutputError (disk full), none.
  void append(std::span<const Record> records);
  void append(const Record& record) { append(std::span(&record, 1)); }
  /// Syncs to disk what has waited for kGroup_s. Throws problems::OutputError.
  void flush_if_due();
  /// Syncs to disk what has not been. Throws problems::OutputError.
  void flush();

 private:
  void write_lines(std::string_view lines);

  std::filesystem::path path_;
  int fd_ = -1;
  bool unsynced_ = false;
  std::chrono::steady_clock::time_point waiting_since_{};
};

}  // namespace conebench::results
