#include "results/journal.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <thread>
#include <unordered_map>

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

std::filesystem::path journal_path(const std::filesystem::path& results_dir) {
  return results_dir / "journal.jsonl";
}

JournalContent read_journal(const std::filesystem::path& path) {
  JournalContent content;
  if (!std::filesystem::exists(path)) return content;
  std::ifstream file(path);
  problems::require(file.good(), path.string(), "cannot be read");

  std::unordered_map<std::string, std::size_t> index_of_task;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.empty()) continue;
    const auto json = nlohmann::json::parse(line, nullptr, false);
    if (json.is_discarded()) {
      ++content.torn_lines;
      continue;
    }
    Record record = record_from_json(json, path.string() + ", line " + std::to_string(number));
    const auto [it, is_new] = index_of_task.try_emplace(task_key(record), content.records.size());
    if (is_new) {
      content.records.push_back(std::move(record));
    } else {
      content.records[it->second] = std::move(record);
    }
  }
  return content;
}

Journal::Journal(const std::filesystem::path& path) : path_(path) {
  if (path.has_parent_path()) make_folder(path.parent_path());
  fd_ = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
  if (fd_ < 0) throw OutputError(path.string(), reason());
  try {
    if (!lock(fd_)) throw OutputError(path.string(), "another campaign is writing to it");
    if (ends_torn(fd_)) write_line("\n");
  } catch (...) {
    ::close(fd_);
    throw;
  }
}

Journal::~Journal() { ::close(fd_); }

void Journal::append(const Record& record) {
  // A name may hold bytes that are no UTF-8; they must not cost the campaign its results.
  const auto replace = nlohmann::json::error_handler_t::replace;
  write_line(to_json(record).dump(-1, ' ', false, replace) + "\n");
}

void Journal::write_line(std::string_view line) {
  const off_t before = ::lseek(fd_, 0, SEEK_END);
  std::string_view left = line;
  bool ok = true;
  while (ok && !left.empty()) {
    const ssize_t done = ::write(fd_, left.data(), left.size());
    if (done > 0) left.remove_prefix(static_cast<std::size_t>(done));
    ok = done > 0 || (done < 0 && errno == EINTR);
  }
  if (ok && ::fsync(fd_) == 0) return;
  const std::string why = reason();
  // If this fails too, readers ignore the torn line.
  if (::ftruncate(fd_, before) != 0) throw OutputError(path_.string(), why + " (torn line left)");
  throw OutputError(path_.string(), why);
}

}  // namespace conebench::results
