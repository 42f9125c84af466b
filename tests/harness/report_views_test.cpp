#include "harness/report_views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>

#include "harness/problem_id.h"
#include "problems/made_backwards.h"
#include "results/record.h"

namespace conebench::harness {
namespace {

using testing::HasSubstr;

class ReportViewsTest : public testing::Test {
 protected:
  ReportViewsTest()
      : folder_(std::filesystem::temp_directory_path() /
                ("conebench-views-test-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~ReportViewsTest() override { std::filesystem::remove_all(folder_); }

  // A problem file, and the records of two solvers of which one solved it.
  void add_problem(const std::string& name, std::uint64_t seed, bool with_geometry) {
    const auto made = problems::make_backwards({.cones = 8, .seed = seed});
    problems::ProblemFile file{made.problem, {}, {}, {}};
    if (with_geometry) {
      file.geometry.emplace();
      file.geometry->points.setRandom(8, 3);
    }
    const auto path = folder_ / (name + ".h5");
    problems::write_problem_file(path, file);
    for (const auto& [solver, eta] : {std::pair{"gs", 1e-7}, {"newton-fb", 1e-2}}) {
      results::Record record;
      record.problem = {.name = name,
                        .content_sha256 = problems::content_sha256(made.problem),
                        .path = path.string(),
                        .family = "dem/" + name,
                        .cones = 8};
      record.solver = solver;
      record.settings = {.tol = 1e-6, .time_limit_s = 5.0};
      record.eta = eta;
      records_.push_back(record);
    }
  }

  std::filesystem::path folder_;
  std::vector<results::Record> records_;
};

TEST_F(ReportViewsTest, SolvesTheProblemAgainWithTheBestSolversFirst) {
  add_problem("one", 1, true);
  const ReportViews shown = make_views(records_);
  EXPECT_EQ(shown.note, "");
  ASSERT_EQ(shown.views.size(), 1u);
  EXPECT_EQ(shown.views[0].name, "one");
  ASSERT_EQ(shown.views[0].answers.size(), 2u);
  EXPECT_EQ(shown.views[0].answers[0].solver, "gs");
  EXPECT_LE(shown.views[0].answers[0].eta, 1e-6);
}

TEST_F(ReportViewsTest, SaysWhatBecameOfTheOthers) {
  add_problem("gone", 1, true);
  add_problem("changed", 2, true);
  add_problem("nowhere", 3, false);
  std::filesystem::remove(folder_ / "gone.h5");
  problems::write_problem_file(
      folder_ / "changed.h5",
      {problems::make_backwards({.cones = 8, .seed = 9}).problem, {}, {}, {}});
  const ReportViews shown = make_views(records_);
  EXPECT_TRUE(shown.views.empty());
  EXPECT_THAT(shown.note, HasSubstr("1 no longer at their place"));
  EXPECT_THAT(shown.note, HasSubstr("1 changed since"));
  EXPECT_THAT(shown.note, HasSubstr("1 without a geometry"));
}

TEST_F(ReportViewsTest, ASolverOfAnotherProgramLeavesNoAnswer) {
  add_problem("one", 1, true);
  for (results::Record& record : records_) record.solver = "no-such-solver";
  const ReportViews shown = make_views(records_);
  EXPECT_TRUE(shown.views.empty());
  EXPECT_THAT(shown.note, HasSubstr("1 without an answer that could be had again"));
}

}  // namespace
}  // namespace conebench::harness
