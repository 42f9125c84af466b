#include "harness/study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

#include "harness/plan_file.h"
#include "problems/error.h"

namespace conebench::harness {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class StudyTest : public testing::Test {
 protected:
  StudyTest()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("conebench-study-" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~StudyTest() override { std::filesystem::remove_all(folder_); }

  Study read(const std::string& text) const {
    const auto path = folder_ / "study.toml";
    std::ofstream(path) << text;
    return read_study(path);
  }

  std::string error_of(const std::string& text) const {
    try {
      check(read(text));
    } catch (const problems::InputError& error) {
      return error.what();
    }
    return "no error";
  }

  std::filesystem::path folder_;
};

constexpr const char* kWhole = R"(
schema = 1
problems = ["collection", "/elsewhere/one.h5"]
where = 'cones > 100'
solvers = ["gs[omega=0.8,1.2]", "auto"]
tol = [1e-4, 1e-8]
mode = ["cold", "sequence"]
donors = ["own", "gs"]
threads = [1, 2]
time_limit = "500ms"
hard_limit = "3s"
memory = "1G"
stop = "own"
repetitions = 3
seed = 7
)";

TEST_F(StudyTest, AWholeStudyIsReadAndChecked) {
  const Study study = read(kWhole);
  EXPECT_THAT(study.problems, ElementsAre((folder_ / "collection").string(), "/elsewhere/one.h5"));
  const Plan plan = check(study);
  ASSERT_EQ(plan.solvers.size(), 3u);
  EXPECT_EQ(plan.solvers[1]->name, "gs[omega=1.2]");
  ASSERT_EQ(plan.stops.size(), 2u);
  EXPECT_EQ(plan.stops[1].tol, 1e-8);
  EXPECT_EQ(plan.stops[1].time_limit_s, 0.5);
  EXPECT_EQ(plan.stops[1].test, solvers::StopTest::kOwn);
  EXPECT_THAT(plan.modes, ElementsAre(Mode::kCold, Mode::kSequence));
  ASSERT_EQ(plan.donors.size(), 2u);
  EXPECT_FALSE(plan.donors[0].has_value());
  EXPECT_EQ((*plan.donors[1])->name, "gs");
  EXPECT_THAT(plan.threads, ElementsAre(1, 2));
  EXPECT_EQ(plan.hard_limit_s, 3.0);
  EXPECT_EQ(plan.memory_limit_bytes, 1ULL << 30);
  EXPECT_EQ(plan.repetitions, 3);
  EXPECT_FALSE(plan.repeat_for_confidence);
  EXPECT_EQ(plan.seed, 7u);
}

TEST_F(StudyTest, RepetitionsMayBeAuto) {
  const Plan plan =
      check(read("schema = 1\nproblems = [\"p\"]\nsolvers = [\"gs\"]\nrepetitions = \"auto\"\n"));
  EXPECT_TRUE(plan.repeat_for_confidence);
  EXPECT_EQ(plan.repetitions, 1);
}

TEST_F(StudyTest, ErrorsNameTheKey) {
  const std::string head = "schema = 1\nproblems = [\"p\"]\nsolvers = [\"gs\"]\n";
  EXPECT_THAT(error_of("schema = 1\nsolvers = [\"gs\"]\n"), HasSubstr("problems"));
  EXPECT_THAT(error_of("schema = 2\n"), HasSubstr("schema"));
  EXPECT_THAT(error_of(head + "tolerance = [1]\n"), HasSubstr("tolerance"));
  EXPECT_THAT(error_of(head + "tol = 1e-4\n"), HasSubstr("tol: "));
  EXPECT_THAT(error_of(head + "tol = []\n"), HasSubstr("empty"));
  EXPECT_THAT(error_of(head + "tol = [-1.0]\n"), HasSubstr("tol"));
  EXPECT_THAT(error_of(head + "tol = [1e-4, 1e-6, 1e-4]\n"), HasSubstr("stands twice"));
  EXPECT_THAT(error_of(head + "threads = [2, 2]\n"), HasSubstr("threads: 2 stands twice"));
  EXPECT_THAT(error_of(head + "mode = [\"hot\"]\n"), HasSubstr("known: cold, warm, sequence"));
  EXPECT_THAT(error_of(head + "threads = [0]\n"), HasSubstr("threads"));
  EXPECT_THAT(error_of(head + "time_limit = \"5 parsecs\"\n"), HasSubstr("time_limit"));
  EXPECT_THAT(error_of(head + "repetitions = \"many\"\n"), HasSubstr("repetitions"));
  EXPECT_THAT(error_of(head + "repetitions = 0\n"), HasSubstr("repetitions"));
  EXPECT_THAT(error_of(head + "stop = \"never\"\n"), HasSubstr("known: common, own"));
  EXPECT_THAT(error_of(head + "donors = [\"nobody\"]\n"), HasSubstr("only mode"));
  EXPECT_THAT(error_of(head + "mode = [\"sequence\"]\ndonors = [\"nobody\"]\n"),
              HasSubstr("nobody"));
  EXPECT_THAT(error_of("schema = \n"), HasSubstr("line 1"));
}

TEST_F(StudyTest, APlanComesBackAsItWas) {
  const PlanFile plan{.study = read(kWhole),
                      .problems = {source_from_file({.name = "n",
                                                     .content_sha256 = "s",
                                                     .path = "/p/q.h5",
                                                     .family = "dem/scene",
                                                     .cones = 12},
                                                    34, true)}};
  write_plan(folder_, plan);
  const PlanFile again = read_plan(folder_);
  EXPECT_EQ(again.study.solvers, plan.study.solvers);
  EXPECT_EQ(again.study.tolerances, plan.study.tolerances);
  EXPECT_EQ(again.study.donors, plan.study.donors);
  EXPECT_EQ(again.study.repetitions, "3");
  ASSERT_EQ(again.problems.size(), 1u);
  EXPECT_EQ(again.problems[0].id.path, "/p/q.h5");
  EXPECT_EQ(again.problems[0].id.cones, 12);
  EXPECT_EQ(again.problems[0].step, 34);
  EXPECT_TRUE(again.problems[0].has_guess);
}

TEST_F(StudyTest, ADamagedPlanIsNamed) {
  EXPECT_THROW(read_plan(folder_), problems::InputError);
  for (const char* text : {"", "{}", "{\"format\": \"conebench-plan\"}",
                           "{\"format\": \"conebench-plan\", \"format_version\": 1}"}) {
    std::ofstream(plan_path(folder_)) << text;
    try {
      read_plan(folder_);
      ADD_FAILURE() << text;
    } catch (const problems::InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("plan.json")) << text;
    }
  }
}

}  // namespace
}  // namespace conebench::harness
