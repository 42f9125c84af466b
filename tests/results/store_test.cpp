#include "results/store.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "problems/error.h"
#include "random_records.h"
#include "results/report.h"

namespace conebench::results {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

class StoreTest : public testing::Test {
 protected:
  StoreTest()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("conebench-store-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~StoreTest() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path path() const { return folder_ / "results.db"; }

  Store stored(const std::vector<Record>& records) const {
    write_store(path(), records);
    return Store(path());
  }

  void expect_refused(const std::string& why) const {
    EXPECT_THAT([&] { Store store(path()); }, ThrowsMessage<problems::InputError>(HasSubstr(why)));
  }

  std::filesystem::path folder_;
};

// Every member away from its default.
Record full_record() {
  Record record = make_record("p \"1\"\n", "gs[omega=0.8]", 3e-9, 0.1);
  record.kind = "peer";
  record.solver_build = "0123abcd";
  record.settings = {.tol = 1e-7,
                     .time_limit_s = Record::kUnknown,
                     .memory_limit_bytes = 1ULL << 40,
                     .stop = "own",
                     .mode = "sequence",
                     .threads = 3,
                     .timing = "repeated"};
  record.repetition = 2;
  record.sequence = {.name = "scene, steps 3 to 12", .id = "abcd", .index = 4, .length = 10};
  record.donor = "ipm";
  record.status = Status::kRefuted;
  record.claimed = "converged";
  record.siconos_residual = 0.1 + 0.2;  // no short decimal
  record.attainable_eta = 1e-300;
  record.guess_eta = 0.5;
  record.model_eta = 0.25;
  record.iterations = 1LL << 40;
  record.setup_s = 1.0 / 3.0;
  record.timed_solves = 7;
  record.time_spread = 0.01;
  record.solver_cpu_s = 0.2;
  record.allocations = 12;
  record.solver_memory_bytes = 13;
  record.wall_s = 1.5;
  record.cpu_s = 1.25;
  record.peak_memory_bytes = 14;
  record.curve = {{0.1, 1, 1.0 / 3.0}, {0.2, 5, Record::kUnknown}};
  record.notes = {"one", "\"two\""};
  record.error = "signal 11";
  return record;
}

TEST_F(StoreTest, ARecordSurvivesTheRoundTrip) {
  auto records = random_records(1);
  records.push_back(full_record());
  const auto found = stored(records).records();
  ASSERT_EQ(found.size(), records.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(to_json(found[i]), to_json(records[i]));
    EXPECT_EQ(task_key(found[i]), task_key(records[i]));
  }
}

TEST_F(StoreTest, EveryMemberOfARecordHasItsColumn) {
  const auto json = to_json(full_record());
  stored({full_record()});
  SQLite::Database database(path().string(), SQLite::OPEN_READONLY);
  SQLite::Statement row(database, "SELECT * FROM record");
  ASSERT_TRUE(row.executeStep());
  for (const auto& [name, value] : json.items()) {
    EXPECT_FALSE(row.getColumn(name.c_str()).isNull() && !value.is_null()) << name;
  }
}

void expect_equal(const TimeTable& found, const TimeTable& expected) {
  EXPECT_EQ(found.tol, expected.tol);
  ASSERT_EQ(found.solvers, expected.solvers);
  ASSERT_EQ(found.rows.size(), expected.rows.size());
  for (std::size_t i = 0; i < found.rows.size(); ++i) {
    EXPECT_EQ(found.rows[i].problem.content_sha256, expected.rows[i].problem.content_sha256);
    EXPECT_EQ(found.rows[i].problem.cones, expected.rows[i].problem.cones);
    EXPECT_EQ(found.rows[i].time_s, expected.rows[i].time_s);
    EXPECT_EQ(found.rows[i].status, expected.rows[i].status);
  }
}

TEST_F(StoreTest, AnswersWhatTheRecordsThemselvesWould) {
  for (std::uint32_t seed = 0; seed < 5; ++seed) {
    auto records = shuffled(random_records(seed, {.not_run_share = 0.1}), seed);
    for (std::size_t i = 0; i < records.size(); i += 2) records[i].settings.tol = 1e-4;
    for (std::size_t i = 0; i < records.size(); i += 5) records[i].solver_build = "0123456789ab";
    for (std::size_t i = 3; i < records.size(); i += 7) records[i].host.cpu = "another";
    records.push_back(make_record("p", "ccp", 0.1, 1.0));
    records.back().kind = "model";
    records.back().settings.tol = 1e-4;
    const Store store = stored(records);
    const auto groups = group_by_settings(records);
    ASSERT_EQ(store.settings().size(), groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const Settings& settings = groups[g].settings;
      EXPECT_THAT(store.settings(), testing::Contains(settings));
      EXPECT_EQ(store.tolerances(settings), tolerance_ladder(settings.tol));
      for (const double tol : store.tolerances(settings)) {
        const TimeTable expected = make_time_table(groups[g].methods, tol);
        expect_equal(store.times(settings, tol), expected);
      }
      const SolvedCounts counts = store.solved(settings);
      const SolvedCounts expected = solved_counts(groups[g].methods, settings.tol);
      EXPECT_EQ(counts.tolerances, expected.tolerances);
      EXPECT_EQ(counts.solvers, expected.solvers);
      EXPECT_EQ(counts.solved, expected.solved);
      EXPECT_EQ(counts.problems, expected.problems);
    }
  }
}

TEST_F(StoreTest, TailsAreThoseOfTheComparableTimes) {
  const auto records = random_records(4, {.not_run_share = 0.1});
  const Settings settings = records.front().settings;
  const auto found = stored(records).tails_of_times(settings, settings.tol);
  const TimeTable table = comparable(make_time_table(records, settings.tol));
  for (std::size_t s = 0; s < table.solvers.size(); ++s) {
    std::vector<double> times_s;
    for (const auto& row : table.rows) times_s.push_back(row.time_s[s]);
    const Tails expected = *tails(times_s), of_store = found.at(table.solvers[s]);
    EXPECT_EQ(of_store.p50, expected.p50);
    EXPECT_EQ(of_store.p99, expected.p99);
    EXPECT_EQ(of_store.max, expected.max);
    EXPECT_EQ(of_store.count, expected.count);
    EXPECT_EQ(of_store.failures, expected.failures);
  }
}

TEST_F(StoreTest, CountsStatusesAndFindsTheRowsOfAProblem) {
  std::vector<Record> records = {make_record("p1", "a", 1e-9, 1), make_record("p2", "a", 1e-3, 1),
                                 make_record("p1", "b", 1e-3, 1)};
  records[1].status = Status::kKilledTime;
  const Store store = stored(records);
  const auto counts = store.statuses(records[0].settings);
  EXPECT_EQ(counts.at("a").at(Status::kConverged), 1);
  EXPECT_EQ(counts.at("a").at(Status::kKilledTime), 1);
  EXPECT_EQ(counts.at("b").at(Status::kStalled), 1);

  const auto rows = store.records_of_problem("sha-of-p1");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].solver, "a");
  EXPECT_EQ(rows[1].solver, "b");
  EXPECT_TRUE(store.records_of_problem("no such content").empty());
}

TEST_F(StoreTest, TwinsOfOneContentAreOneProblem) {
  std::vector<Record> records = {make_record("p1", "a", 1e-9, 1), make_record("p1", "b", 1e-9, 1)};
  records[1].problem.path = "/elsewhere/twin.dat";
  const Store store = stored(records);
  EXPECT_EQ(store.times(records[0].settings, 1e-8).rows.size(), 1u);
  EXPECT_EQ(store.records_of_problem("sha-of-p1").size(), 2u);
}

TEST_F(StoreTest, EveryQuestionIsAnsweredFromAnIndex) {
  stored(random_records(2));
  SQLite::Database database(path().string(), SQLite::OPEN_READONLY);
  for (const char* question :
       {"SELECT problem_id, time_s FROM outcome WHERE settings_id = 1 AND tol = 1e-8 AND "
        "contender_id = 1",
        "SELECT solved FROM solved WHERE settings_id = 1 AND contender_id = 1",
        "SELECT solver_id, status_id, count(*) FROM task WHERE settings_id = 1 GROUP BY solver_id, "
        "status_id",
        "SELECT * FROM record WHERE id IN (SELECT task.id FROM problem JOIN task ON problem.id = "
        "problem_id WHERE content_sha256 = 'x')"}) {
    SQLite::Statement plan(database, std::string("EXPLAIN QUERY PLAN ") + question);
    while (plan.executeStep()) {
      const std::string step = plan.getColumn(3).getString();
      EXPECT_THAT(step, testing::Not(testing::StartsWith("SCAN task"))) << question;
      EXPECT_THAT(step, testing::Not(testing::StartsWith("SCAN outcome"))) << question;
      EXPECT_THAT(step, testing::Not(HasSubstr("TEMP B-TREE"))) << question;
    }
  }
}

TEST_F(StoreTest, AnEmptyStoreHasNoSettings) {
  EXPECT_TRUE(stored({}).settings().empty());
  EXPECT_TRUE(Store(path()).records().empty());
}

TEST_F(StoreTest, ATaskThatIsThereTwiceIsRefusedAndTheOldStoreStays) {
  const Record record = make_record("p1", "a", 1e-9, 1);
  write_store(path(), std::vector{record});
  EXPECT_THROW(write_store(path(), std::vector{record, record}), problems::InputError);
  EXPECT_EQ(Store(path()).records().size(), 1u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

TEST_F(StoreTest, ReplacesTheStoreBefore) {
  write_store(path(), random_records(1));
  write_store(path(), std::vector{make_record("p1", "a", 1e-9, 1)});
  EXPECT_EQ(Store(path()).records().size(), 1u);
}

TEST_F(StoreTest, AnUnwritablePlaceIsAnOutputError) {
  EXPECT_THROW(write_store("/proc/no-such-place/results.db", {}), problems::OutputError);
  std::filesystem::create_directories(path() / "in the way");
  EXPECT_THROW(write_store(path(), random_records(1)), problems::OutputError);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_), {}), 1);
}

TEST_F(StoreTest, RefusesWhatIsNoStore) {
  expect_refused("is no file");
  std::ofstream(path()) << "no database at all, but long enough to look at\n";
  expect_refused("expected a store");
  std::filesystem::remove(path());
  SQLite::Database(path().string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE)
      .exec("CREATE TABLE t (x)");
  expect_refused("another program");
}

TEST_F(StoreTest, RefusesAnotherVersion) {
  write_store(path(), random_records(1));
  SQLite::Database(path().string(), SQLite::OPEN_READWRITE).exec("PRAGMA user_version = 99");
  expect_refused("version 99");
}

TEST_F(StoreTest, RefusesATruncatedStore) {
  write_store(path(), random_records(1));
  const auto whole = std::filesystem::file_size(path());
  for (const double share : {0.0, 0.001, 0.1, 0.5, 0.9, 0.999}) {
    write_store(path(), random_records(1));
    std::filesystem::resize_file(path(),
                                 static_cast<std::uintmax_t>(share * static_cast<double>(whole)));
    EXPECT_THROW(Store(path()).records(), problems::InputError) << share;
  }
}

TEST_F(StoreTest, NamesTheTolerancesItKnows) {
  const auto records = random_records(1);
  const Store store = stored(records);
  EXPECT_THAT([&] { store.times(records[0].settings, 3e-5); },
              ThrowsMessage<problems::InputError>(HasSubstr("1e-05")));
  Settings other = records[0].settings;
  other.threads = 9;
  EXPECT_THROW(store.times(other, 1e-8), problems::InputError);
}

}  // namespace
}  // namespace conebench::results
