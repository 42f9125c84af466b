// Ensembles of runs with made numbers, whose means, spreads and verdicts are known.

#include "harness/trajectory_findings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "harness/trajectory_report.h"
#include "results/svg_plot.h"

namespace conebench::harness {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kFrontPlace = static_cast<std::size_t>(Observable::kFront);

TrajectoryRow row(const std::string& solver, double tol, std::int64_t seed, double front) {
  TrajectoryRow made{.key = "", .solver = solver, .tol = tol, .seed = seed};
  made.reference = solver == "auto";
  made.observed.fill(0.5);
  made.observed[kFrontPlace] = front;
  return made;
}

// Reference fronts 1, 2, 3 (mean 2, spread 1); those of `gs` are off by what is given for each of
// the tolerances 1e-1, 1e-2, 1e-3.
struct Ensemble {
  explicit Ensemble(const std::vector<double>& off) {
    plan.scene = "made";
    plan.engine = "dem";
    plan.solvers = {"gs"};
    plan.tolerances = {1e-1, 1e-2, 1e-3};
    plan.seeds = {1, 2, 3};
    plan.reference = "auto";
    plan.reference_tol = 1e-8;
    for (const std::int64_t seed : plan.seeds) {
      const auto front = static_cast<double>(seed);
      rows.push_back(row("auto", 1e-8, seed, front));
      for (std::size_t k = 0; k < 3; ++k) {
        rows.push_back(row("gs", plan.tolerances[k], seed, front + off[k]));
      }
    }
  }
  Findings findings() const { return find(plan, rows); }

  TrajectoryPlan plan;
  std::vector<TrajectoryRow> rows;
};

TEST(SampleOf, IsMeanAndSampleDeviationOfWhatThereIs) {
  const Sample sample = sample_of({2.0, kNone, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0});
  EXPECT_EQ(sample.count, 8u);
  EXPECT_DOUBLE_EQ(sample.mean, 5.0);
  EXPECT_NEAR(sample.spread, std::sqrt(32.0 / 7.0), 1e-15);
  EXPECT_TRUE(std::isnan(sample_of({3.0}).spread));
  EXPECT_TRUE(std::isnan(sample_of({kNone}).mean));
}

TEST(Findings, DeviationsAreFromTheRunOfTheSameSeed) {
  const Findings findings = Ensemble({0.5, 0.25, 0.0}).findings();
  const Finding& loosest = findings.lines.front()[Observable::kFront];
  EXPECT_DOUBLE_EQ(loosest.value.mean, 2.5);
  EXPECT_DOUBLE_EQ(loosest.value.spread, 1.0);
  EXPECT_DOUBLE_EQ(loosest.deviation.mean, 0.5);
  EXPECT_NEAR(loosest.deviation.spread, 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(findings.yardstick(Observable::kFront), 1.0);
}

TEST(Findings, EnoughIsTheLoosestToleranceWithinTheSpread) {
  EXPECT_EQ(Ensemble({0.9, 0.1, 0.0}).findings().enough("gs", Observable::kFront), 1e-1);
  EXPECT_EQ(Ensemble({-1.1, -0.9, 0.0}).findings().enough("gs", Observable::kFront), 1e-2);
  EXPECT_EQ(Ensemble({5.0, 4.0, 2.0}).findings().enough("gs", Observable::kFront), std::nullopt);
}

TEST(Findings, ALooseToleranceThatIsRightByChanceIsNotEnough) {
  EXPECT_EQ(Ensemble({0.0, 3.0, 0.1}).findings().enough("gs", Observable::kFront), 1e-3);
  EXPECT_EQ(Ensemble({0.0, 0.0, 3.0}).findings().enough("gs", Observable::kFront), std::nullopt);
}

TEST(Findings, DeviationsOfOppositeSignsCancelInTheMeanAndShowInTheSpread) {
  Ensemble ensemble({0.0, 0.0, 0.0});
  ensemble.rows[1].observed[kFrontPlace] += 2.0;  // seed 1 to 1e-1
  ensemble.rows[5].observed[kFrontPlace] -= 2.0;  // seed 2 to 1e-1
  const Findings findings = ensemble.findings();
  const Finding& loosest = findings.lines.front()[Observable::kFront];
  EXPECT_NEAR(loosest.deviation.mean, 0.0, 1e-15);
  EXPECT_DOUBLE_EQ(loosest.deviation.spread, 2.0);
  EXPECT_EQ(loosest.within, true);
}

TEST(Findings, EnergyDriftIsHeldAgainstTheSpreadOfTheEnergyChange) {
  Ensemble ensemble({0.0, 0.0, 0.0});
  for (TrajectoryRow& run : ensemble.rows) {
    auto& change = run.observed[static_cast<std::size_t>(Observable::kEnergyChange)];
    auto& drift = run.observed[static_cast<std::size_t>(Observable::kEnergyDrift)];
    change = -10.0 * static_cast<double>(run.seed);
    drift = run.reference ? 0.0 : 50.0 * run.tol;
  }
  const Findings findings = ensemble.findings();
  EXPECT_DOUBLE_EQ(findings.yardstick(Observable::kEnergyDrift), 10.0);
  EXPECT_EQ(findings.enough("gs", Observable::kEnergyDrift), 1e-1);
}

TEST(Findings, AFailedRunOrAMissingValueIsNeverEnough) {
  Ensemble failed({0.0, 0.0, 0.0});
  failed.rows[1].error = "not finite";
  failed.rows[1].observed.fill(kNone);
  const Findings with_failure = failed.findings();
  EXPECT_EQ(with_failure.lines.front().failed, 1u);
  EXPECT_EQ(with_failure.lines.front()[Observable::kFront].within, std::nullopt);
  EXPECT_EQ(with_failure.enough("gs", Observable::kFront), 1e-2);
  EXPECT_THAT(trajectory_text(with_failure), HasSubstr(" 1 |\n"));
}

TEST(Findings, OneSeedHasNoYardstick) {
  Ensemble ensemble({0.0, 0.0, 0.0});
  ensemble.plan.seeds = {1};
  ensemble.plan.seed_matters = false;
  ensemble.rows.resize(4);
  const Findings findings = ensemble.findings();
  EXPECT_TRUE(std::isnan(findings.yardstick(Observable::kFront)));
  EXPECT_EQ(findings.enough("gs", Observable::kFront), std::nullopt);
  EXPECT_THAT(trajectory_text(findings), HasSubstr("The seed changes nothing in this scene"));
  EXPECT_TRUE(to_json(findings)["reference"]["observed"]["front_m"]["spread"].is_null());
}

TEST(TrajectoryReport, HoldsTheSameNumbersInEveryForm) {
  const Findings findings = Ensemble({1.5, 0.25, 0.0}).findings();
  const auto json = to_json(findings);
  EXPECT_EQ(json["lines"][1]["tol"], 1e-2);
  EXPECT_EQ(json["lines"][1]["observed"]["front_m"]["deviation"]["mean"], 0.25);
  EXPECT_EQ(json["lines"][0]["observed"]["front_m"]["within"], false);
  for (const auto& entry : json["enough"]) {
    if (entry["observable"] != "front_m") continue;
    EXPECT_EQ(entry["tol"], 1e-2);
  }
  EXPECT_THAT(trajectory_csv(findings), HasSubstr("front_m,m,\"gs\",0.01,0,3,2.25,1,0.25,0,1,1\n"));
  EXPECT_THAT(trajectory_text(findings), HasSubstr("2.25 +- 1"));
  EXPECT_THAT(trajectory_markdown(findings, "conebench study made"), HasSubstr("(front_m.svg)"));
}

TEST(TrajectoryReport, PlotsShowTheSpreadOfEveryPointOnTheReferencesBand) {
  const Findings findings = Ensemble({1.5, 0.25, 0.0}).findings();
  const std::vector<results::Plot> plots = trajectory_plots(findings);
  const auto front = std::find_if(plots.begin(), plots.end(),
                                  [](const results::Plot& plot) { return plot.id == "front_m"; });
  ASSERT_NE(front, plots.end());
  ASSERT_TRUE(front->band.has_value());
  EXPECT_DOUBLE_EQ(front->band->range.low, 1.0);
  EXPECT_DOUBLE_EQ(front->band->range.high, 3.0);
  ASSERT_EQ(front->series.size(), 1u);
  const results::PlotPoint& point = front->series.front().points.front();
  EXPECT_DOUBLE_EQ(point.y, 3.5);
  ASSERT_TRUE(point.y_interval.has_value());
  EXPECT_DOUBLE_EQ(point.y_interval->low, 2.5);
  const std::string picture = results::svg(*front, results::SvgUse::kFile);
  EXPECT_THAT(picture, HasSubstr("class=\"band\""));
  EXPECT_THAT(picture, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace conebench::harness
