#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "results/record.h"

namespace conebench::results {

/// Records of several sources, each task once: of a task that two hold, the later record.
class Merger {
 public:
  void add(std::vector<Record> records);

  const std::vector<Record>& records() const { return records_; }
  std::size_t doubles() const { return doubles_; }

 private:
  std::vector<Record> records_;
  std::unordered_map<std::string, std::size_t> place_of_task_;
  std::size_t doubles_ = 0;
};

/// FOLDER/journal.jsonl with these records, sorted by task, so that equal sets of records give
/// equal files. Atomic. Throws problems::OutputError, also when the folder has a journal already.
void write_merged_journal(const std::filesystem::path& folder, std::span<const Record> records);

}  // namespace conebench::results
