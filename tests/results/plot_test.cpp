#include "results/plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "make_record.h"
#include "results/anytime.h"
#include "results/scaling.h"
#include "results/speed_plots.h"
#include "results/svg_plot.h"

namespace conebench::results {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> labels(const Axis& axis) {
  std::vector<std::string> texts;
  for (const Tick& tick : ticks(axis)) texts.push_back(tick.label);
  return texts;
}

TEST(Axis, PlacesValuesFromEndToEnd) {
  const Axis log{.quantity = Quantity::kTime, .scale = Scale::kLog10, .low = 1e-3, .high = 1.0};
  EXPECT_DOUBLE_EQ(log.place(1e-3), 0.0);
  EXPECT_NEAR(log.place(std::sqrt(1e-3)), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(log.place(7.0), 1.0);
  EXPECT_DOUBLE_EQ(log.place(0.0), 0.0);
  Axis falling = log;
  falling.falling = true;
  EXPECT_DOUBLE_EQ(falling.place(1e-3), 1.0);
}

TEST(Axis, HasRoundTicks) {
  EXPECT_THAT(labels({.quantity = Quantity::kShare}),
              ElementsAre("0 %", "20 %", "40 %", "60 %", "80 %", "100 %"));
  EXPECT_THAT(labels({.quantity = Quantity::kTime, .scale = Scale::kLog10, .low = 1e-4, .high = 1}),
              ElementsAre("100 us", "1 ms", "10 ms", "100 ms", "1 s"));
  EXPECT_THAT(labels({.quantity = Quantity::kRatio, .scale = Scale::kLog2, .low = 1, .high = 8}),
              ElementsAre("1", "2", "4", "8"));
  EXPECT_THAT(labels({.scale = Scale::kLog10, .low = 0.1}),
              ElementsAre("10 %", "20 %", "50 %", "100 %"));
}

TEST(Axis, OfManyDecadesHasFewTicks) {
  const Axis wide{.quantity = Quantity::kEta, .scale = Scale::kLog10, .low = 1e-16, .high = 10};
  EXPECT_LE(ticks(wide).size(), 10u);
  EXPECT_GE(ticks(wide).size(), 4u);
}

TEST(Axis, TicksOfANarrowRangeDiffer) {
  const std::vector<std::string> shown =
      labels({.quantity = Quantity::kRatio, .low = 0.24371, .high = 0.24382});
  ASSERT_GE(shown.size(), 3u);
  EXPECT_EQ(std::set<std::string>(shown.begin(), shown.end()).size(), shown.size());
  EXPECT_THAT(labels({.quantity = Quantity::kRatio, .low = -0.5, .high = 0.5}),
              testing::Contains("0"));
}

TEST(LinearAxis, HoldsTheFiniteValuesAndARange) {
  const std::vector<double> values = {-2.0, 3.0, Record::kUnknown};
  const Axis axis = linear_axis("x", Quantity::kRatio, values);
  EXPECT_LT(axis.low, -2.0);
  EXPECT_GT(axis.low, -3.0);
  EXPECT_GT(axis.high, 3.0);
  const std::vector<double> alike = {7.0, 7.0 * (1.0 + 1e-15)};
  const Axis narrow = linear_axis("x", Quantity::kRatio, alike);
  EXPECT_LT(narrow.low, 7.0);
  EXPECT_GT(narrow.high - narrow.low, 0.1);
  EXPECT_EQ(linear_axis("x", Quantity::kRatio, std::vector<double>{0.0}).place(0.0), 0.5);
}

TEST(LogAxis, EndsAtPowersOfTenAroundTheFiniteValues) {
  const std::vector<double> values = {0.02, 5.0, Record::kUnknown, 0.0};
  const Axis axis = log_axis("t", Quantity::kTime, values);
  EXPECT_NEAR(axis.low, 0.01, 1e-12);
  EXPECT_NEAR(axis.high, 10.0, 1e-9);
}

TEST(Thinning, KeepsTheEndsAndWhatCanBeSeen) {
  const Axis axis;
  std::vector<PlotPoint> line;
  for (int i = 0; i <= 100'000; ++i) line.push_back({.x = i * 1e-5, .y = i * 1e-5});
  const auto thin = thinned(line, axis, axis);
  EXPECT_LE(thin.size(), 450u);
  EXPECT_DOUBLE_EQ(thin.front().x, 0.0);
  EXPECT_DOUBLE_EQ(thin.back().x, 1.0);
  for (std::size_t i = 1; i < thin.size(); ++i) EXPECT_LE(thin[i].x - thin[i - 1].x, 0.0051);
  const std::vector<PlotPoint> jump = {
      {.x = 0, .y = 0}, {.x = 1e-6, .y = 0.5}, {.x = 2e-6, .y = 1}};
  EXPECT_EQ(thinned(jump, axis, axis).size(), 3u);
}

// Two problems: "a" solves both in 1 and 2 s, "b" the first in 4 s.
Group two_by_two() {
  Group group;
  group.methods = {make_record("p1", "a", 1e-9, 1.0), make_record("p2", "a", 1e-9, 2.0),
                   make_record("p1", "b", 1e-9, 4.0), make_record("p2", "b", 1e-3, 5.0)};
  group.settings = group.methods.front().settings;
  return group;
}

std::vector<std::pair<double, double>> points(const Series& series) {
  std::vector<std::pair<double, double>> all;
  for (const PlotPoint& p : series.points) all.emplace_back(p.x, p.y);
  return all;
}

TEST(SpeedPlots, HoldWhatIsKnownOfTwoProblems) {
  const Group group = two_by_two();
  const GroupNumbers numbers(group);
  const Plot profile = profile_plots(numbers).front();
  EXPECT_EQ(profile.choice, "eta <= 1e-08");
  EXPECT_EQ(profile.series[0].name, "a");
  EXPECT_EQ(profile.series[0].note, "2/2");
  EXPECT_THAT(points(profile.series[0]), ElementsAre(std::pair(1.0, 1.0)));
  EXPECT_THAT(points(profile.series[1]), ElementsAre(std::pair(1.0, 0.0), std::pair(4.0, 0.5)));

  const Plot time = time_plots(numbers).front();
  EXPECT_THAT(points(time.series[0]), ElementsAre(std::pair(1.0, 0.5), std::pair(2.0, 1.0)));

  const Plot tolerance = tolerance_plot(numbers);
  EXPECT_DOUBLE_EQ(tolerance.series[1].points.front().y, 1.0);  // 1e-3 meets 1e-1
  EXPECT_DOUBLE_EQ(tolerance.series[1].points.back().y, 0.5);

  const Plot missed = missed_plot(numbers);
  EXPECT_DOUBLE_EQ(missed.series[1].points.back().y, 0.5);
  EXPECT_NEAR(missed.y.low, 0.1, 1e-12);
}

TEST(Anytime, HoldsTheStartUntilTheFirstLookAndNeverMoreThanWasVerified) {
  Record record = make_record("p", "a", 1e-4, 1.0);
  record.guess_eta = 0.8;
  record.curve = {{0.1, 1, 0.5}, {0.2, 2, 1e-6}, {1.0, 3, 1e-3}};
  const std::vector<double> times = {0.05, 0.1, 0.5, 2.0};
  EXPECT_THAT(eta_held(record, times), ElementsAre(0.8, 0.5, 1e-4, 1e-4));
  record.curve.clear();
  EXPECT_THAT(eta_held(record, times), ElementsAre(0.8, 0.8, 0.8, 1e-4));
}

TEST(Anytime, ACurveKeepsEachGainAndItsEnd) {
  Record record = make_record("p", "a", 1e-4, 1.0);
  record.curve = {{0.1, 1, 1.0}, {0.2, 2, 0.9}, {0.3, 3, 0.4}, {0.4, 4, 0.7}, {0.5, 5, 0.39}};
  const auto points = best_so_far(record, 2.0);
  ASSERT_EQ(points.size(), 3u);
  EXPECT_DOUBLE_EQ(points[1].eta, 0.4);
  EXPECT_DOUBLE_EQ(points[2].time_s, 0.5);
}

TEST(Scaling, FindsTheExponentOfAPowerLaw) {
  std::vector<double> x, y;
  for (const double cones : {10.0, 40.0, 90.0, 500.0}) {
    x.push_back(cones);
    y.push_back(3e-6 * std::pow(cones, 1.5));
  }
  EXPECT_NEAR(power_of(x, y).value(), 1.5, 1e-12);
  EXPECT_FALSE(power_of(std::vector<double>{10, 20}, std::vector<double>{1, 2}).has_value());
}

TEST(SvgPlot, EscapesNamesAndNeedsNothingOutsideItself) {
  Plot plot = profile_plots(GroupNumbers(two_by_two())).front();
  plot.series[0].name = "a<b>\"&";
  const std::string file = svg(plot, SvgUse::kFile);
  EXPECT_THAT(file, HasSubstr("a&lt;b&gt;&quot;&amp;"));
  EXPECT_THAT(file, HasSubstr("<style>"));
  EXPECT_THAT(svg(plot, SvgUse::kPage), testing::Not(HasSubstr("<style>")));
}

TEST(Svg, DrawsABandAndTheIntervalsOfPoints) {
  const Plot plot{.id = "p",
                  .title = "height",
                  .mark = Mark::kLines,
                  .x = {.quantity = Quantity::kRatio},
                  .y = {.quantity = Quantity::kRatio},
                  .band = Band{.range = {0.25, 0.75}, .name = "reference"},
                  .series = {{.name = "gs",
                              .points = {{.x = 0.5, .y = 0.5, .y_interval = Interval{0.0, 1.0}}}}}};
  const std::string picture = svg(plot, SvgUse::kFile);
  // The frame is 480 x 320 px with its corner at (74, 48).
  EXPECT_THAT(picture, HasSubstr(R"(<rect x="74.0" y="128.0" width="480.0" height="160.0")"));
  EXPECT_THAT(picture,
              HasSubstr(R"(<line x1="314.0" y1="368.0" x2="314.0" y2="48.0" class="c s0")"));
  EXPECT_THAT(picture, HasSubstr(">reference</text>"));
}

}  // namespace
}  // namespace conebench::results
