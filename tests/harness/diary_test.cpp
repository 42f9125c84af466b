#include "harness/diary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace conebench::harness {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class DiaryTest : public testing::Test {
 protected:
  DiaryTest()
      : folder_(std::filesystem::path(testing::TempDir()) /
                ("conebench-diary-" + std::to_string(::getpid()))) {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  ~DiaryTest() override { std::filesystem::remove_all(folder_); }

  static json calibration(double arithmetic_s) {
    return {{"arithmetic_s", arithmetic_s},
            {"memory_s", 0.02},
            {"arithmetic_spread", 0.01},
            {"memory_spread", 0.01}};
  }

  // Of a run that came to its end without drift.
  static json run(double arithmetic_s) {
    return {{"command", "conebench run"},
            {"calibration_before", calibration(arithmetic_s)},
            {"calibration_after", calibration(arithmetic_s)},
            {"drift", json::array()}};
  }

  void write(const std::string& name, const json& diary) const {
    std::ofstream(folder_ / name) << diary;
  }

  std::filesystem::path folder_;
};

TEST_F(DiaryTest, ARunOnASteadyMachineHasNoMark) {
  write("campaign.json", run(0.01));
  EXPECT_THAT(machine_marks(folder_), IsEmpty());
  EXPECT_THAT(machine_marks(folder_ / "nowhere"), IsEmpty());
}

TEST_F(DiaryTest, ADriftIsMarkedWithItsShard) {
  json diary = run(0.01);
  diary["drift"] = {"time of arithmetic: +20.0 % (7.0 % is noise)"};
  write("campaign-1-of-2.json", run(0.01));
  write("campaign-2-of-2.json", diary);
  EXPECT_THAT(machine_marks(folder_),
              ElementsAre("campaign-2-of-2: time of arithmetic: +20.0 % (7.0 % is noise)"));
}

TEST_F(DiaryTest, AThrottledMachineShowsAgainstTheOthersThoughItNeverDrifts) {
  for (int shard = 1; shard <= 5; ++shard) {
    write("campaign-" + std::to_string(shard) + "-of-5.json", run(shard == 4 ? 0.015 : 0.01));
  }
  EXPECT_THAT(machine_marks(folder_),
              ElementsAre(AllOf(HasSubstr("campaign-4-of-5, against the median of the runs"),
                                HasSubstr("arithmetic: +50.0 %"))));
}

TEST_F(DiaryTest, AResumedRunKeepsWhatWasSaidOfTheOnesBefore) {
  json killed = run(0.01);
  killed.erase("calibration_after");
  killed.erase("drift");
  write("campaign.json", killed);
  {
    Diary diary(folder_, {}, "conebench run again", 1);
    diary.before();
    diary.after();
  }
  EXPECT_EQ(campaign_command(folder_), "conebench run again");
  json again;
  std::ifstream(folder_ / "campaign.json") >> again;
  ASSERT_EQ(again.at("earlier").size(), 1u);
  EXPECT_EQ(again.at("earlier")[0], killed);
  EXPECT_THAT(machine_marks(folder_),
              testing::Contains("campaign, run 1: it ended without its second calibration"));
}

TEST_F(DiaryTest, OfManyRunsTheLastAreKept) {
  write("campaign.json", run(0.01));
  for (int i = 0; i < 30; ++i) Diary(folder_, {}, std::to_string(i), 1);
  json last;
  std::ifstream(folder_ / "campaign.json") >> last;
  EXPECT_EQ(last.at("earlier").size(), 20u);
  EXPECT_EQ(last.at("earlier").back().at("command"), "28");
}

TEST_F(DiaryTest, GoAlongWhenFoldersAreMerged) {
  json drifted = run(0.01);
  drifted["drift"] = {"a sign"};
  write("campaign.json", drifted);
  write("campaign-3-of-9.json", run(0.01));
  copy_diaries({folder_, folder_}, folder_ / "joined");
  EXPECT_THAT(
      machine_marks(folder_ / "joined"),
      testing::UnorderedElementsAre("campaign-folder-1: a sign", "campaign-folder-2: a sign"));
  EXPECT_EQ(campaign_command(folder_ / "joined"), "conebench run");
}

TEST_F(DiaryTest, DamageIsNoMark) {
  std::ofstream(folder_ / "campaign.json") << "{\"calibration_before\": 3";
  write("campaign-1-of-2.json", {{"calibration_before", "fast"}, {"drift", {1, 2}}});
  EXPECT_THAT(machine_marks(folder_), IsEmpty());
}

}  // namespace
}  // namespace conebench::harness
