#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "results/line_file.h"
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

/// Appends records to a journal, one JSON line each; as safe as results/line_file.h says.
class Journal {
 public:
  static constexpr double kFlush_s = LineFile::kFlush_s;
  static constexpr double kGroup_s = LineFile::kGroup_s;
  static constexpr double kAsk_s = LineFile::kAsk_s;

  /// Opens or creates the journal; terminates a torn last line. Throws problems::OutputError when
  /// the place is not writable or another process holds the lock.
  explicit Journal(const std::filesystem::path& path) : file_(path) {}

  /// The records of one task: all of their lines or, with problems::OutputError (disk full), none.
  void append(std::span<const Record> records);
  void append(const Record& record) { append(std::span(&record, 1)); }
  /// Syncs to disk what has waited for kGroup_s. Throws problems::OutputError.
  void flush_if_due() { file_.flush_if_due(); }
  /// Syncs to disk what has not been. Throws problems::OutputError.
  void flush() { file_.flush(); }

 private:
  LineFile file_;
};

}  // namespace conebench::results
