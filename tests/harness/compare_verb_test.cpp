#include <nlohmann/json.hpp>

#include "results/journal.h"
#include "tests/harness/program_test.h"

namespace conebench::harness {
namespace {

using results::Record;
using testing::HasSubstr;

// BASE: what the repository keeps for its own comparison; NEW: the same, changed.
class CompareVerbTest : public ProgramTest {
 protected:
  static constexpr const char* kBase = CONEBENCH_SOURCE_DIR "/tests/data/ci-baseline";

  static std::vector<Record> baseline() { return results::read_results(kBase).records; }

  void write_new(const std::vector<Record>& records) const {
    results::Journal(results::journal_path(folder_ / "new")).append(records);
  }

  Ran compare(const std::string& options) const {
    return conebench(std::string("compare ") + kBase + " new " + options);
  }
};

TEST_F(CompareVerbTest, EqualResultsPassTheGate) {
  write_new(baseline());
  const Ran ran = compare("--gate 'iterations < 1.1 && gm(eta) < 10 && failures <= 0'");
  EXPECT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("54 pairs of rows"));
  EXPECT_THAT(ran.out, HasSubstr("gate passed"));
  for (const char* name : {"sgm(time)", "p50(time)", "p99(time)", "max(time)", "gm(eta)",
                           "iterations", "worst(iterations)", "solved", "failures", "missing"}) {
    EXPECT_THAT(ran.out, HasSubstr(name));
  }
}

TEST_F(CompareVerbTest, MoreIterationsFailTheGate) {
  auto records = baseline();
  for (Record& record : records) record.iterations = 2 * record.iterations + 1;
  write_new(records);
  const Ran ran = compare("--gate 'iterations < 1.1'");
  EXPECT_EQ(ran.code, 1) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("gate FAILED: iterations < 1.1"));
  EXPECT_EQ(compare("--gate 'failures <= 0'").code, 0);
  EXPECT_EQ(compare("").code, 0);
}

TEST_F(CompareVerbTest, OneSolverThatTakesTwiceAsManyDoesNotHideInAMean) {
  auto records = baseline();
  Record& one = records[7];
  one.iterations = 3 * std::max<std::int64_t>(one.iterations, 1);
  write_new(records);
  EXPECT_EQ(compare("--gate 'iterations < 1.1'").code, 0);
  EXPECT_EQ(compare("--gate 'worst(iterations) < 2'").code, 1);
}

TEST_F(CompareVerbTest, ANewFailureFailsTheGateAndIsNamed) {
  auto records = baseline();
  records[0].eta = 0.1;
  records[0].status = results::Status::kRefuted;
  write_new(records);
  const Ran ran = compare("--gate 'failures <= 0'");
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.out, HasSubstr("solved in BASE, not in NEW: 1\n  " + records[0].solver + " on " +
                                 records[0].problem.name));
}

TEST_F(CompareVerbTest, RowsWithoutAPartnerAreCountedAndNamed) {
  auto records = baseline();
  const Record left_out = records.back();
  records.pop_back();
  write_new(records);
  const Ran ran = compare("--gate 'missing <= 0'");
  EXPECT_EQ(ran.code, 1);
  EXPECT_THAT(ran.out, HasSubstr("rows without a partner in NEW: 1\n  " + left_out.solver));
}

TEST_F(CompareVerbTest, TheJsonHoldsItAll) {
  write_new(baseline());
  const Ran ran = compare("--json --gate 'failures <= 0'");
  EXPECT_EQ(ran.code, 0) << ran.err;
  const auto json = nlohmann::json::parse(ran.out);
  EXPECT_EQ(json["pairs"], 54);
  EXPECT_EQ(json["quantities"]["iterations"]["value"], 1.0);
  EXPECT_EQ(json["quantities"]["failures"]["value"], 0.0);
  EXPECT_EQ(json["gate"]["passed"], true);
  EXPECT_TRUE(json["only_new"].empty());
  EXPECT_TRUE(json["noise"].is_null());
}

TEST_F(CompareVerbTest, ABadGateIsBadUseAndSoAreResultsThatAreNotThere) {
  write_new(baseline());
  const std::string both = std::string("compare ") + kBase + " new ";
  expect_usage_error(both + "--gate 'sgm(tme) < 1'", "did you mean 'sgm(time)'?");
  expect_usage_error(both + "--gate 'failures <= 0 &&'", "at its end");
  expect_usage_error(both + "--gate 'failures'", "expected a comparison");
  expect_usage_error(both + "--gate 'failures <= \"none\"'", "do not compare");
  expect_usage_error("compare no-such-results new", "no-such-results");
  expect_usage_error("compare new", "NEW");
}

TEST_F(CompareVerbTest, ResultsWithoutACommonTaskAreBadInput) {
  auto records = baseline();
  for (Record& record : records) record.solver = "another";
  write_new(records);
  expect_usage_error(std::string("compare ") + kBase + " new --gate 'failures <= 0'",
                     "none of the 54 rows of BASE");
}

TEST_F(CompareVerbTest, TheReportExportsForGoogleBenchmark) {
  write_new(baseline());
  const Ran ran = conebench("report new --format gbench");
  EXPECT_EQ(ran.code, 0) << ran.err;
  const auto json = nlohmann::json::parse(content(folder_ / "new" / "gbench.json"));
  EXPECT_EQ(json["benchmarks"].size(), 54u);
}

// Where Debian's libbenchmark-tools and python3-scipy are.
TEST_F(CompareVerbTest, GoogleBenchmarksOwnScriptReadsTheExport) {
  const std::string script = "/usr/bin/python3 /usr/share/benchmark/compare.py ";
  if (std::system((script + "--help > /dev/null 2>&1").c_str()) != 0) {
    GTEST_SKIP() << "no compare.py of Google Benchmark that runs";
  }
  auto records = baseline();
  for (Record& record : records) {
    record.setup_s *= 2.0;
    record.solve_s *= 2.0;
  }
  records[0].eta = 0.1;
  records[0].status = results::Status::kKilledTime;
  write_new(records);
  EXPECT_EQ(conebench(std::string("report ") + kBase + " --format gbench -o base").code, 0);
  EXPECT_EQ(conebench("report new --format gbench").code, 0);
  const std::string command = "cd '" + folder_.string() + "' && " + script +
                              "--no-color benchmarks base/gbench.json new/gbench.json > table.txt";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string table = content(folder_ / "table.txt");
  EXPECT_THAT(table, HasSubstr(records[1].solver + "/" + records[1].problem.name));
  std::size_t doubled = 0;
  for (auto at = table.find(" +1.0000 "); at != table.npos; at = table.find(" +1.0000 ", at + 1)) {
    ++doubled;
  }
  EXPECT_EQ(doubled, 53u) << table;  // and the failure is nobody's partner
}

}  // namespace
}  // namespace conebench::harness
