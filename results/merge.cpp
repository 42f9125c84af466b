#include "results/merge.h"

#include <map>
#include <nlohmann/json.hpp>

#include "problems/error.h"
#include "results/journal.h"
#include "results/output.h"

namespace conebench::results {

void Merger::add(std::vector<Record> records) {
  for (Record& record : records) {
    const auto [it, is_new] = place_of_task_.try_emplace(task_key(record), records_.size());
    if (is_new) {
      records_.push_back(std::move(record));
      continue;
    }
    ++doubles_;
    Record& kept = records_[it->second];
    if (record.started_at >= kept.started_at) kept = std::move(record);
  }
}

void write_merged_journal(const std::filesystem::path& folder, std::span<const Record> records) {
  const auto path = journal_path(folder);
  if (std::filesystem::exists(path)) {
    throw problems::OutputError(path.string(), "exists already; merge into a new folder");
  }
  std::map<std::string, std::string> lines;
  for (const Record& record : records) {
    lines[task_key(record)] =
        to_json(record).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  std::string text;
  for (const auto& [key, line] : lines) text += line + "\n";
  write_text_file(path, text);
}

}  // namespace conebench::results
