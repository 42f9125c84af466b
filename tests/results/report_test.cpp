#include "results/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "make_record.h"
#include "problems/error.h"
#include "results/svg_profile.h"
#include "results/text.h"

namespace conebench::results {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<Record> two_solvers() {
  Record dead = make_record("p1", "spg", Record::kUnknown, 0.0);
  dead.status = Status::kKilledTime;
  return {make_record("p1", "gs", 1e-9, 0.0123), dead};
}

TEST(Report, ShowsTimesAndFailuresWithTheirStatus) {
  const std::string text = markdown_report(two_solvers(), "conebench run -p a -s gs spg");
  EXPECT_THAT(text, HasSubstr("12.3 ms"));
  EXPECT_THAT(text, HasSubstr("— killed_time"));
  EXPECT_THAT(text, HasSubstr("conebench run -p a -s gs spg"));
  EXPECT_THAT(text, HasSubstr("not an error bound"));
  EXPECT_THAT(text, HasSubstr("a processor, 2 cores"));
  for (const char* tol : {"1e-04", "1e-06", "1e-08"}) {
    EXPECT_THAT(text, HasSubstr(std::string("Verified eta <= ") + tol));
  }
}

TEST(Report, KeepsModelsOutOfTheRanking) {
  auto records = two_solvers();
  records.push_back(make_record("p1", "ccp", 0.02, 0.001));
  records.back().kind = "model";
  const std::string text = markdown_report(records, "");
  EXPECT_THAT(ranking_table(group_by_settings(records)[0].methods, 1e-4), Not(HasSubstr("ccp")));
  EXPECT_THAT(text, HasSubstr("## Models"));
  EXPECT_THAT(text, HasSubstr("2.0e-02"));
}

TEST(Report, ComparesOnlyWhatRanUnderTheSameRules) {
  auto records = two_solvers();
  records.push_back(make_record("p1", "gs", 1e-9, 0.5));
  records.back().settings.stop = "own";
  EXPECT_EQ(group_by_settings(records).size(), 2u);
}

TEST(Report, TheCsvHasOneRowATaskAndQuotesWhatNeedsIt) {
  auto records = two_solvers();
  records[0].solver = "gs[form=delassus,omega=0.8]";
  records[0].notes = {"says \"hello\""};
  const std::string csv = csv_report(records);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
  EXPECT_THAT(csv, HasSubstr("\"gs[form=delassus,omega=0.8]\""));
  EXPECT_THAT(csv, HasSubstr("\"says \"\"hello\"\"\""));
  EXPECT_THAT(csv, Not(HasSubstr("inf")));
}

TEST(Report, WritesItsFiles) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("conebench-report-" + std::to_string(::getpid()));
  const auto written = write_report(folder, two_solvers(), "", {"md", "csv"});
  for (const char* name : {"report.md", "results.csv", "profile.svg"}) {
    EXPECT_GT(std::filesystem::file_size(folder / name), 100u);
  }
  EXPECT_EQ(written.size(), 3u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 3);
  std::filesystem::remove_all(folder);
}

TEST(Report, RefusesUnknownFormatsAndEmptyResults) {
  EXPECT_THROW(write_report("x", {}, "", {"md"}), problems::InputError);
  EXPECT_THROW(write_report("x", two_solvers(), "", {"pdf"}), problems::InputError);
}

TEST(ProfileImage, HasACurveAndALegendEntryForEverySolver) {
  const TimeTable table = make_time_table(two_solvers(), 1e-8);
  const std::string svg = profile_svg(table, rank(table), "a < b");
  EXPECT_THAT(svg, HasSubstr("gs (1/1)"));
  EXPECT_THAT(svg, HasSubstr("spg (0/1)"));
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  EXPECT_THAT(svg, testing::StartsWith("<svg"));
  EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
}

TEST(Text, TimesHaveThreeDigitsAndAUnit) {
  EXPECT_EQ(format_time(4.5e-6), "4.50 us");
  EXPECT_EQ(format_time(0.0123), "12.3 ms");
  EXPECT_EQ(format_time(0.9999), "1.00 s");
  EXPECT_EQ(format_time(123.4), "123 s");
  EXPECT_EQ(format_time(Record::kUnknown), "-");
}

}  // namespace
}  // namespace conebench::results
