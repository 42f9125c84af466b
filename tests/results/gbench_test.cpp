#include "results/gbench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "make_record.h"

namespace conebench::results {
namespace {

using nlohmann::json;

std::vector<Record> three_runs() {
  Record first = make_record("p1", "gs[omega=0.8]", 1e-9, 0.25), second = first;
  first.setup_s = 0.05;
  first.solver_cpu_s = 0.2;
  first.timed_solves = 12;
  second.repetition = 1;
  Record failed = make_record("p1", "gs[omega=0.8]", Record::kUnknown, 9.9);
  failed.repetition = 2;
  failed.status = Status::kKilledTime;
  return {first, second, failed};
}

TEST(GoogleBenchmark, ARunHasTheMembersOfTheFormat) {
  const json report = json::parse(gbench_report(three_runs()));
  for (const char* key : {"date", "host_name", "executable", "num_cpus", "mhz_per_cpu",
                          "cpu_scaling_enabled", "caches", "load_avg", "library_build_type"}) {
    EXPECT_TRUE(report["context"].contains(key)) << key;
  }
  const json& run = report["benchmarks"][0];
  EXPECT_EQ(run["name"], "gs[omega=0.8]/p1@sha-of-p/tol:1e-08");
  EXPECT_EQ(run["run_name"], run["name"]);
  EXPECT_EQ(run["run_type"], "iteration");
  EXPECT_EQ(run["repetitions"], 2);
  EXPECT_EQ(run["repetition_index"], 0);
  EXPECT_EQ(report["benchmarks"][1]["repetition_index"], 1);
  EXPECT_EQ(run["threads"], 1);
  EXPECT_EQ(run["iterations"], 12);
  EXPECT_DOUBLE_EQ(run["real_time"], 0.3e9);
  EXPECT_DOUBLE_EQ(run["cpu_time"], 0.2e9);
  EXPECT_EQ(run["time_unit"], "ns");
  EXPECT_EQ(run["eta"], 1e-9);
}

// compare.py groups the benchmarks by name and reads real_time, cpu_time and time_unit of each.
TEST(GoogleBenchmark, AFailureHasNoTimeAndSharesNoNameWithATime) {
  const json report = json::parse(gbench_report(three_runs()));
  ASSERT_EQ(report["benchmarks"].size(), 2u);
  ASSERT_EQ(report["failures"].size(), 1u);
  std::set<std::string> timed;
  for (const json& run : report["benchmarks"]) {
    if (run.contains("real_time")) timed.insert(run["name"]);
  }
  const json& failed = report["failures"][0];
  EXPECT_EQ(failed["error_occurred"], true);
  EXPECT_EQ(failed["error_message"], "killed_time");
  EXPECT_EQ(failed["name"], "gs[omega=0.8]/p1@sha-of-p/tol:1e-08/failed:killed_time");
  for (const char* key : {"real_time", "cpu_time", "time_unit"}) EXPECT_FALSE(failed.contains(key));
  EXPECT_FALSE(timed.contains(failed["name"]));
}

TEST(GoogleBenchmark, ALateAnswerIsAFailure) {
  Record late = make_record("p1", "gs", 1e-9, 11.0);  // the limit is 10 s
  const json report = json::parse(gbench_report(std::vector{late}));
  EXPECT_TRUE(report["benchmarks"].empty());
  EXPECT_EQ(report["failures"][0]["error_message"], "after the time limit");
}

TEST(GoogleBenchmark, DifferentRulesAreDifferentBenchmarks) {
  std::vector<Record> records(6, make_record("p1", "gs", 1e-9, 0.1));
  records[1].settings.tol = 1e-4;
  records[2].settings.mode = "warm";
  records[3].settings.threads = 2;
  records[4].settings.stop = "own";
  records[5].settings.timing = "repeated";
  std::set<std::string> names;
  const json report = json::parse(gbench_report(records));
  for (const json& run : report["benchmarks"]) names.insert(run["name"]);
  EXPECT_EQ(names.size(), 6u);
}

TEST(GoogleBenchmark, FamiliesAreSolvers) {
  const std::vector<Record> records = {make_record("p1", "a", 1e-9, 1),
                                       make_record("p1", "b", 1e-9, 1),
                                       make_record("p2", "a", 1e-9, 1)};
  const json runs = json::parse(gbench_report(records))["benchmarks"];
  EXPECT_EQ(runs[0]["family_index"], runs[2]["family_index"]);
  EXPECT_NE(runs[0]["family_index"], runs[1]["family_index"]);
  EXPECT_NE(runs[0]["per_family_instance_index"], runs[2]["per_family_instance_index"]);
}

}  // namespace
}  // namespace conebench::results
