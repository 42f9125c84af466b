#include "results/journal.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>
#include <unordered_map>

#include "problems/error.h"
#include "results/merge.h"
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

Journal::Journal(const std::filesystem::path& path) : path_(path) {
  if (path.has_parent_path()) make_folder(path.parent_path());
  fd_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (fd_ < 0) throw OutputError(path.string(), reason());
  try {
    if (!lock(fd_)) throw OutputError(path.string(), "another campaign is writing to it");
    if (ends_torn(fd_)) write_lines("\n");
  } catch (...) {
    ::close(fd_);
    throw;
  }
}

Journal::~Journal() {
  if (unsynced_) ::fdatasync(fd_);
  ::close(fd_);
}

void Journal::append(std::span<const Record> records) {
  // A name may hold bytes that are no UTF-8; they must not cost the campaign its results.
  const auto replace = nlohmann::json::error_handler_t::replace;
  std::string lines;
  for (const Record& record : records)
    lines += to_json(record).dump(-1, ' ', false, replace) + "\n";
  write_lines(lines);
  flush_if_due();
}

void Journal::flush_if_due() {
  const std::chrono::duration<double> waited = std::chrono::steady_clock::now() - waiting_since_;
  if (waited.count() >= kGroup_s) flush();
}

void Journal::write_lines(std::string_view lines) {
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

void Journal::flush() {
  if (!unsynced_) return;
  if (::fdatasync(fd_) != 0) throw OutputError(path_.string(), reason());
  unsynced_ = false;
}

}  // namespace conebench::results
