#include "results/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <tuple>

#include "make_record.h"
#include "problems/error.h"
#include "results/speed_plots.h"
#include "results/svg_plot.h"
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
  const auto records = two_solvers();
  const std::string text =
      markdown_report({.records = records, .command = "conebench run -p a -s gs spg"});
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
  // One answer that solves the model, one that does not: whose eta is nobody's gap.
  for (const auto& [problem, gap, own] :
       {std::tuple{"p1", 0.02, 1e-9}, std::tuple{"p2", 0.75, 0.5}}) {
    records.push_back(make_record(problem, "ccp", gap, 0.001));
    records.back().kind = "model";
    records.back().model_eta = own;
  }
  const std::string text = markdown_report({.records = records});
  EXPECT_THAT(ranking_table(group_by_settings(records)[0].methods, 1e-4), Not(HasSubstr("ccp")));
  EXPECT_THAT(text, HasSubstr("## Models"));
  EXPECT_THAT(text, HasSubstr("2.0e-02"));
  EXPECT_THAT(text, HasSubstr("1.0e-09"));
  EXPECT_THAT(text, Not(HasSubstr("7.5e-01")));
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
  const auto records = two_solvers();
  const auto written =
      write_report({.records = records}, {.folder = folder, .formats = {"md", "csv"}});
  for (const char* name : {"report.md", "results.csv", "profile.svg"}) {
    EXPECT_GT(std::filesystem::file_size(folder / name), 100u);
  }
  EXPECT_EQ(written.size(), 3u);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 3);
  std::filesystem::remove_all(folder);
}

TEST(Report, RefusesUnknownFormatsAndEmptyResults) {
  const auto records = two_solvers();
  EXPECT_THROW(write_report({.records = {}}, {.folder = "x", .formats = {"md"}}),
               problems::InputError);
  EXPECT_THROW(write_report({.records = records}, {.folder = "x", .formats = {"pdf"}}),
               problems::InputError);
}

TEST(ProfileImage, HasACurveAndALegendEntryForEverySolver) {
  const TimeTable table = make_time_table(two_solvers(), 1e-8);
  Plot plot = profile_plot(table, rank(table));
  plot.title = "a < b";
  const std::string image = svg(plot, SvgUse::kFile);
  EXPECT_THAT(image, HasSubstr("gs (1/1)"));
  EXPECT_THAT(image, HasSubstr("spg (0/1)"));
  EXPECT_THAT(image, HasSubstr("a &lt; b"));
  EXPECT_THAT(image, testing::StartsWith("<svg"));
  EXPECT_THAT(image, testing::EndsWith("</svg>\n"));
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
