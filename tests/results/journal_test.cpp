#include "results/journal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "make_record.h"
#include "problems/error.h"

namespace conebench::results {
namespace {

class JournalTest : public testing::Test {
 protected:
  JournalTest()
      : folder_(std::filesystem::temp_directory_path() /
                ("conebench-journal-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(folder_);
  }
  ~JournalTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path path() const { return journal_path(folder_); }

  void cut_last_bytes(std::uintmax_t count) {
    std::filesystem::resize_file(path(), std::filesystem::file_size(path()) - count);
  }

  std::filesystem::path folder_;
};

TEST_F(JournalTest, KeepsEveryFieldOfARecord) {
  Record record = make_record("p", "gs[omega=0.8]", 3e-9, 0.25);
  record.curve = {{0.0, 0, 1.0}, {0.1, 12, Record::kUnknown}};
  record.notes = {"W is singular", "\"quoted\", with a comma"};
  record.error = "SIGSEGV";
  record.siconos_residual = 0.125;
  record.peak_memory_bytes = 1ULL << 40;
  Journal(path()).append(record);

  const auto content = read_journal(path());
  ASSERT_EQ(content.records.size(), 1u);
  EXPECT_EQ(to_json(content.records[0]), to_json(record));
  EXPECT_TRUE(std::isinf(content.records[0].curve[1].eta));
  EXPECT_EQ(content.records[0].peak_memory_bytes, 1ULL << 40);
}

TEST_F(JournalTest, NumbersThatAreNotFiniteAreNullInTheFile) {
  Record record = make_record("p", "a", std::nan(""), 0.0);
  record.status = Status::kNotFinite;
  const auto json = nlohmann::json::parse(to_json(record).dump());
  EXPECT_TRUE(json["eta"].is_null());
  EXPECT_EQ(json["status"], "not_finite");
  EXPECT_FALSE(record_from_json(json, "test").solved());
}

TEST_F(JournalTest, ReadsRecordsFromBeforeModelsHadAnEtaOfTheirOwn) {
  Record record = make_record("p", "ccp", 0.02, 1.0);
  record.model_eta = 1e-9;
  auto json = to_json(record);
  EXPECT_EQ(record_from_json(json, "test").model_eta, 1e-9);
  json.erase("model_eta");
  EXPECT_EQ(record_from_json(json, "test").model_eta, Record::kUnknown);
}

TEST_F(JournalTest, IgnoresATornLastLineAndEndsItBeforeGoingOn) {
  {
    Journal journal(path());
    journal.append(make_record("p1", "a", 1e-9, 1));
    journal.append(make_record("p2", "a", 1e-9, 1));
  }
  cut_last_bytes(40);
  EXPECT_EQ(read_journal(path()).records.size(), 1u);
  EXPECT_EQ(read_journal(path()).torn_lines, 1);

  Journal(path()).append(make_record("p3", "a", 1e-9, 1));
  const auto content = read_journal(path());
  ASSERT_EQ(content.records.size(), 2u);
  EXPECT_EQ(content.records[0].problem.name, "p1");
  EXPECT_EQ(content.records[1].problem.name, "p3");
  EXPECT_EQ(content.torn_lines, 1);
}

TEST_F(JournalTest, ALineThatOnlyLacksItsEndCounts) {
  Journal(path()).append(make_record("p1", "a", 1e-9, 1));
  cut_last_bytes(1);
  EXPECT_EQ(read_journal(path()).records.size(), 1u);
  Journal(path()).append(make_record("p2", "a", 1e-9, 1));
  EXPECT_EQ(read_journal(path()).records.size(), 2u);
  EXPECT_EQ(read_journal(path()).torn_lines, 0);
}

TEST_F(JournalTest, EveryPlaceToCutALineIsSurvived) {
  Journal(path()).append(make_record("p1", "a", 1e-9, 1));
  const auto whole = std::filesystem::file_size(path());
  std::ifstream file(path());
  const std::string line((std::istreambuf_iterator<char>(file)), {});
  for (std::uintmax_t length = 0; length + 1 < whole; ++length) {
    std::ofstream(path(), std::ios::trunc) << line.substr(0, length);
    EXPECT_TRUE(read_journal(path()).records.empty()) << length;
  }
}

TEST_F(JournalTest, TheLastRecordOfATaskCounts) {
  {
    Journal journal(path());
    journal.append(make_record("p1", "a", 1e-3, 1));
    journal.append(make_record("p1", "b", 1e-9, 1));
    journal.append(make_record("p1", "a", 1e-9, 2));
  }
  const auto content = read_journal(path());
  ASSERT_EQ(content.records.size(), 2u);
  EXPECT_TRUE(content.records[0].solved());
}

TEST_F(JournalTest, TwoWritersAreRefused) {
  const Journal first(path());
  EXPECT_THROW(Journal second(path()), problems::OutputError);
}

TEST_F(JournalTest, AFolderThatCannotBeMadeIsAnOutputError) {
  EXPECT_THROW(Journal("/proc/no-such-place/journal.jsonl"), problems::OutputError);
}

TEST_F(JournalTest, AFullDiskIsAnOutputError) {
  if (::access("/dev/full", W_OK) != 0) GTEST_SKIP() << "no /dev/full here";
  Journal journal("/dev/full");
  EXPECT_THROW(journal.append(make_record("p1", "a", 1e-9, 1)), problems::OutputError);
}

TEST_F(JournalTest, ALineOfAnotherKindIsAnInputErrorThatNamesIt) {
  std::filesystem::create_directories(folder_);
  std::ofstream(path()) << "{\"problem\": 3}\n";
  try {
    read_journal(path());
    FAIL();
  } catch (const problems::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("line 1"), std::string::npos) << error.what();
  }
}

TEST(TaskKey, DependsOnTheTaskAndNotOnItsResult) {
  const Record base = make_record("p", "a", 1e-9, 1);
  EXPECT_EQ(task_key(base), task_key(make_record("p", "a", 1.0, 99)));
  EXPECT_EQ(task_key(base).size(), 32u);
  EXPECT_NE(task_key(base), task_key(make_record("q", "a", 1e-9, 1)));
  EXPECT_NE(task_key(base), task_key(make_record("p", "b", 1e-9, 1)));
  for (auto change :
       {+[](Record& r) { r.settings.tol = 1e-6; }, +[](Record& r) { r.settings.time_limit_s = 1; },
        +[](Record& r) { r.settings.memory_limit_bytes = 1; },
        +[](Record& r) { r.settings.stop = "own"; }, +[](Record& r) { r.repetition = 1; },
        +[](Record& r) { r.solver_build = "another"; },
        +[](Record& r) { r.settings.mode = "warm"; }, +[](Record& r) { r.settings.threads = 2; },
        +[](Record& r) { r.settings.timing = "repeated"; }, +[](Record& r) { r.donor = "b"; },
        +[](Record& r) { r.host.cpu = "another"; }, +[](Record& r) { r.host.cores = 99; }}) {
    Record changed = base;
    change(changed);
    EXPECT_NE(task_key(base), task_key(changed));
  }
}

}  // namespace
}  // namespace conebench::results
