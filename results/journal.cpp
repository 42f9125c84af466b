#include "results/journal.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "problems/error.h"
#include "results/merge.h"

namespace conebench::results {
namespace {

// The complete lines of one journal.
std::vector<Record> read_lines(const std::filesystem::path& path, int& torn_lines) {
  std::vector<Record> records;
  if (!std::filesystem::exists(path)) return records;
  std::ifstream file(path);
  problems::require(file.good(), path.string(), "cannot be read");
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.empty()) continue;
    const auto json = nlohmann::json::parse(line, nullptr, false);
    if (json.is_discarded()) {
      ++torn_lines;
    } else {
      records.push_back(record_from_json(json, path.string() + ", line " + std::to_string(number)));
    }
  }
  return records;
}

// Without the sequences of which records are missing.
std::vector<Record> whole_tasks(std::vector<Record> records, int& torn_lines) {
  std::unordered_map<std::string, int> present;
  for (const Record& record : records) ++present[sequence_key(record)];
  const auto dropped = std::erase_if(records, [&](const Record& record) {
    return present[sequence_key(record)] < record.sequence.length;
  });
  torn_lines += static_cast<int>(dropped);
  return records;
}

JournalContent read_all(const std::vector<std::filesystem::path>& paths) {
  JournalContent content;
  Merger merger;
  for (const auto& path : paths) merger.add(read_lines(path, content.torn_lines));
  content.records = whole_tasks(merger.records(), content.torn_lines);
  return content;
}

}  // namespace

std::filesystem::path journal_path(const std::filesystem::path& results_dir, Shard shard) {
  if (shard.count == 1) return results_dir / "journal.jsonl";
  return results_dir / fmt::format("journal-{}-of-{}.jsonl", shard.index, shard.count);
}

JournalContent read_journal(const std::filesystem::path& path) { return read_all({path}); }

JournalContent read_results(const std::filesystem::path& results_dir) {
  std::vector<std::filesystem::path> journals;
  if (std::filesystem::is_directory(results_dir)) {
    for (const auto& entry : std::filesystem::directory_iterator(results_dir)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with("journal") && name.ends_with(".jsonl")) journals.push_back(entry.path());
    }
  }
  std::sort(journals.begin(), journals.end());
  return read_all(journals);
}

void Journal::append(std::span<const Record> records) {
  // A name may hold bytes that are no UTF-8; they must not cost the campaign its results.
  const auto replace = nlohmann::json::error_handler_t::replace;
  std::string lines;
  for (const Record& record : records)
    lines += to_json(record).dump(-1, ' ', false, replace) + "\n";
  file_.append(lines);
}

}  // namespace conebench::results
