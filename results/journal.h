#pragma once

#include <filesystem>
#include <vector>

#include "results/record.h"

namespace conebench::results {

/// RESULTS_DIR/journal.jsonl.
std::filesystem::path journal_path(const std::filesystem::path& results_dir);

/// What a journal holds. A line counts if it is one complete record: a line that a kill or a power
/// loss has cut short does not, and its task is simply not done yet.
struct JournalContent {
  std::vector<Record> records;  ///< in the order written; of a task that ran twice, only the last
  int torn_lines = 0;           ///< lines that do not count
};

/// A journal that does not exist is empty. Throws problems::InputError when it cannot be read.
JournalContent read_journal(const std::filesystem::path& path);

/// Appends records to a journal, one JSON line each, synced to disk before append() returns.
/// Holds a lock, so that two campaigns never write to one journal.
class Journal {
 public:
  /// Opens or creates the journal; terminates a torn last line. Throws problems::OutputError when
  /// the place is not writable or another process holds the lock.
  explicit Journal(const std::filesystem::path& path);
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  /// All of the line or, with problems::OutputError (disk full), nothing.
  void append(const Record& record);

 private:
  void write_line(std::string_view line);

  std::filesystem::path path_;
  int fd_ = -1;
};

}  // namespace conebench::results
