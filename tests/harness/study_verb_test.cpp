// `conebench study` as it is called.

#include <nlohmann/json.hpp>

#include "tests/harness/program_test.h"

namespace conebench::harness {
namespace {

using testing::HasSubstr;

const std::string kSmall =
    "study sand-column --set grid.cells=[16,4] --set grid.size_m=[4,1] "
    "--set blocks[0].jitter=0.5 --steps 4 -s gs --tol 1e-1,1e-2 --seeds 2 --reference-tol 1e-6";

class StudyVerb : public ProgramTest {};

TEST_F(StudyVerb, WritesItsReportAndOneFigureAQuantity) {
  const Ran ran = conebench(kSmall + " -o out");
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.out, HasSubstr("enough for"));
  for (const char* file : {"study.md", "study.csv", "runs.jsonl", "front_m.svg",
                           "energy_drift_J.svg", "penetration.svg", "step_time_s.svg"}) {
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / file)) << file;
  }
  const std::string runs = content(folder_ / "out" / "runs.jsonl");
  EXPECT_EQ(std::count(runs.begin(), runs.end(), '\n'), 6);
  EXPECT_THAT(content(folder_ / "out" / "study.md"), HasSubstr("conebench study sand-column"));
}

TEST_F(StudyVerb, GoesOnFromItsFolder) {
  ASSERT_EQ(conebench(kSmall + " -o out").code, 0);
  const Ran more = conebench(kSmall + ",1e-3 -o out");
  EXPECT_THAT(conebench(kSmall + " -o out").err, HasSubstr("6 runs: 0 done now, 6 kept"));
  EXPECT_EQ(more.code, 2) << "a tolerance belongs behind --tol";
  std::string with_more = kSmall;
  with_more.replace(with_more.find("1e-1,1e-2"), 9, "1e-1,1e-2,1e-3");
  EXPECT_THAT(conebench(with_more + " -o out").err, HasSubstr("8 runs: 2 done now, 6 kept"));
}

TEST_F(StudyVerb, InterruptedItKeepsWhatIsDoneAndGoesOnFromThere) {
  const std::string longer =
      "study sand-column --set grid.cells=[16,4] --set grid.size_m=[4,1] --set "
      "blocks[0].jitter=0.5 --steps 3000 -s gs --tol 1e-1 --seeds 3 --reference-tol 1e-6 -o out";
  const std::string command = "cd '" + folder_.string() +
                              "' && timeout --preserve-status -s INT 1 " CONEBENCH_PROGRAM " " +
                              longer + " > out.txt 2> err.txt";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 130);
  EXPECT_THAT(content(folder_ / "err.txt"), HasSubstr("the same command goes on"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "study.md"));
  const std::string runs = content(folder_ / "out" / "runs.jsonl");
  const auto done = std::count(runs.begin(), runs.end(), '\n');
  EXPECT_LT(done, 6);
  EXPECT_THAT(conebench(longer).err,
              HasSubstr(std::to_string(6 - done) + " done now, " + std::to_string(done) + " kept"));
}

TEST_F(StudyVerb, PrintsOneObject) {
  const Ran ran = conebench(kSmall + " --json");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto object = nlohmann::json::parse(ran.out);
  EXPECT_EQ(object["scene"], "sand-column");
  EXPECT_EQ(object["lines"].size(), 2u);
  EXPECT_EQ(object["seeds"].size(), 2u);
  EXPECT_TRUE(object["lines"][0]["observed"]["front_m"]["mean"].is_number());
}

TEST_F(StudyVerb, RunsSpheresToo) {
  const Ran ran = conebench("study stack --steps 5 --tol 1e-2 --json");
  ASSERT_EQ(ran.code, 0) << ran.err;
  const auto object = nlohmann::json::parse(ran.out);
  EXPECT_EQ(object["seed_matters"], false);
  const auto& observed = object["lines"][0]["observed"];
  EXPECT_NEAR(observed["centre_height_m"]["mean"].get<double>(), 0.1, 1e-4);
  EXPECT_NEAR(observed["energy_change_J"]["mean"].get<double>(), 0.0, 1e-4);
}

TEST_F(StudyVerb, WrongWishesAreOneLineAndExitCodeTwo) {
  expect_usage_error("study sand-colum", "did you mean 'sand-column'?");
  expect_usage_error("study sand-column --seeds 0", "--seeds");
  expect_usage_error("study sand-column --tol 1e-9", "expected looser than the reference");
  expect_usage_error("study sand-column -s gss", "gss");
  expect_usage_error("study sand-column --reference-time-limit soon", "--reference-time-limit");
}

}  // namespace
}  // namespace conebench::harness
