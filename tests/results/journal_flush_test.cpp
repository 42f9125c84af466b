// When a journal syncs: this program's own fdatasync() counts the calls before it makes them.

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "make_record.h"
#include "results/journal.h"

namespace {
int syncs = 0;
}

extern "C" int fdatasync(int file) {
  ++syncs;
  return static_cast<int>(::syscall(SYS_fdatasync, file));
}

namespace conebench::results {
namespace {

void wait(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

class JournalFlush : public testing::Test {
 protected:
  JournalFlush()
      : folder_(std::filesystem::temp_directory_path() /
                ("conebench-flush-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(folder_);
    syncs = 0;
  }
  ~JournalFlush() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_;
};

TEST_F(JournalFlush, RecordsThatComeTogetherShareASync) {
  Journal journal(journal_path(folder_));
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < 200; ++i) journal.append(make_record("p" + std::to_string(i), "a", 1e-9, 1));
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  EXPECT_LE(syncs, took.count() / Journal::kGroup_s);
  journal.flush();
  const int so_far = syncs;
  EXPECT_GE(so_far, 1);
  journal.flush();  // nothing is left to sync
  EXPECT_EQ(syncs, so_far);
}

TEST_F(JournalFlush, WhatWasAskedInTimeIsSyncedInTime) {
  EXPECT_LT(Journal::kGroup_s + Journal::kAsk_s, Journal::kFlush_s);
  Journal journal(journal_path(folder_));
  journal.append(make_record("p", "a", 1e-9, 1));
  journal.flush_if_due();
  wait(Journal::kGroup_s);
  journal.flush_if_due();
  EXPECT_EQ(syncs, 1);
  wait(Journal::kGroup_s);
  journal.flush_if_due();
  EXPECT_EQ(syncs, 1);
}

TEST_F(JournalFlush, TheEndOfAJournalIsASync) {
  { Journal(journal_path(folder_)).append(make_record("p", "a", 1e-9, 1)); }
  EXPECT_EQ(syncs, 1);
}

}  // namespace
}  // namespace conebench::results
