#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/dem/generators/made.h"
#include "tests/engine/scene_text.h"

namespace conebench::test {
namespace {

using std::numbers::pi;
using testing::HasSubstr;

std::string wall(const std::string& keys) {
  return made_head() + "[[walls]]\nbase_m = [1, 0, 2]\nsize_m = [0.2, 0.1, 0.05]\n" + keys + kStone;
}

TEST(Wall, CoursesAreEquallyLongAndTheirJointsStaggered) {
  const Made made(wall("courses = 3\nbricks = 4\n"));
  EXPECT_EQ(made.bodies.count(), 4 + 5 + 4);
  EXPECT_EQ(made.touching().size(), 3u + 4 + 3 + 8 + 8);
  EXPECT_NEAR(made.mass_kg(), 3 * 0.8 * 0.1 * 0.05 * kDensity, 1e-11);
  expect_box(made, {0.6, -0.05, 2.0}, {1.4, 0.05, 2.15});
}

TEST(Wall, GapsOpenTheJointsOfACourse) {
  const Made made(wall("courses = 2\nbricks = 4\ngap_m = 0.02\n"));
  EXPECT_EQ(made.touching().size(), 8u);
  EXPECT_NEAR(made.mass_kg(), (4 * 0.2 + 3 * 0.2 + 2 * 0.09) * 0.1 * 0.05 * kDensity, 1e-11);
  expect_box(made, {0.57, -0.05, 2.0}, {1.43, 0.05, 2.1});
}

TEST(Wall, StandsInThePlane) {
  const Made made(in_the_plane(wall("courses = 3\nbricks = 1\n")));
  EXPECT_EQ(made.touching().size(), 5u);
  expect_box(made, {0.9, -0.05, 2.0}, {1.1, 0.05, 2.15});
}

TEST(Wall, WhatCannotBeIsRefused) {
  EXPECT_THAT(error_of(wall("courses = 0\nbricks = 1\n")), HasSubstr("walls[0].courses: found 0"));
  EXPECT_THAT(error_of(wall("courses = 1\nbricks = 0\n")), HasSubstr("walls[0].bricks: found 0"));
  EXPECT_THAT(error_of(wall("courses = 1\nbricks = 1\ngap_m = 0.2\n")),
              HasSubstr("walls[0].gap_m: found 0.2, expected less than the length of a brick"));
  EXPECT_THAT(error_of(changed(wall("courses = 1\nbricks = 1\n"), "0.1, 0.05]", "0.1, 0]")),
              HasSubstr("walls[0].size_m"));
  EXPECT_THAT(error_of(in_the_plane(changed(wall("courses = 1\nbricks = 1\n"), "[1, 0", "[1, 3"))),
              HasSubstr("walls: base_m: found y = 3"));
  expect_material_is_checked(wall("courses = 1\nbricks = 1\n"));
}

std::string arch(const std::string& keys) {
  return made_head() + "[[arches]]\nmean_radius_m = 1\ndepth_m = 0.3\n" + keys + kStone;
}

TEST(Arch, EqualWedgesTouchFaceToFaceFromSpringerToSpringer) {
  const std::string text = arch("voussoirs = 9\nthickness_m = 0.2\nbase_m = [0, 0, 2]\n");
  for (const std::string& scene : {text, in_the_plane(text)}) {
    const Made made(scene);
    EXPECT_EQ(made.bodies.count(), 11);
    EXPECT_FALSE(made.bodies.is_free(0) || made.bodies.is_free(10));
    std::set<std::pair<int, int>> joints;
    for (int i = 0; i < 10; ++i) joints.emplace(i, i + 1);
    EXPECT_EQ(made.touching(), joints);
    const double area = 0.5 * std::sin(pi / 9) * (1.1 * 1.1 - 0.9 * 0.9);
    EXPECT_NEAR(made.mass_kg(), 9 * area * 0.3 * kDensity, 1e-11);
    expect_box(made, {-1.1, -0.15, 2.0}, {1.1, 0.15, 2.0 + 1.1 * std::cos(pi / 18)});
  }
}

TEST(Arch, JointsAreAsDeepAsTheArch) {
  const Made made(arch("voussoirs = 9\nthickness_m = 0.2\n"));
  double lowest = 1e9, highest = 0.0;
  for (const dem::Near& near : made.near_within(Made::kRounding)) {
    lowest = std::min(lowest, std::hypot(near.touch.point.x(), near.touch.point.z()));
    highest = std::max(highest, std::hypot(near.touch.point.x(), near.touch.point.z()));
  }
  EXPECT_NEAR(lowest, 0.9, 1e-9);
  EXPECT_NEAR(highest, 1.1, 1e-9);
}

TEST(Arch, AFlatterOneSpringsFromBetweenItsBase) {
  const double half = pi / 3;
  const Made made(arch("voussoirs = 6\nthickness_m = 0.2\nembrace_rad = 2.0943951023931953\n"));
  EXPECT_NEAR(made.bounds().max().x(), 1.1 * std::sin(half), 1e-14);
  EXPECT_NEAR(made.bounds().min().z(), (0.9 - 1.0) * std::cos(half), 1e-14);
}

TEST(Arch, WhatCannotBeIsRefused) {
  EXPECT_THAT(error_of(arch("voussoirs = 9\nthickness_m = 2\n")),
              HasSubstr("arches[0].thickness_m: found 2, expected less than 2 mean_radius_m = 2"));
  EXPECT_THAT(error_of(arch("voussoirs = 0\nthickness_m = 0.2\n")),
              HasSubstr("arches[0].voussoirs: found 0"));
  EXPECT_THAT(error_of(arch("voussoirs = 1\nthickness_m = 0.2\n")),
              HasSubstr("arches[0].embrace_rad"));
  EXPECT_THAT(error_of(arch("voussoirs = 9\nthickness_m = 0.2\nembrace_rad = 6.2\n")),
              HasSubstr("at most a full circle"));
  expect_material_is_checked(arch("voussoirs = 9\nthickness_m = 0.2\n"));
}

std::string tower(const std::string& keys) {
  return made_head() + "[[towers]]\nsize_m = [0.12, 0.02, 0.01]\n" + keys + kStone;
}

TEST(Tower, PlanksLieCrosswise) {
  const Made made(tower("levels = 3\nplanks = 3\nbase_m = [1, 2, 3]\n"));
  EXPECT_EQ(made.bodies.count(), 9);
  EXPECT_EQ(made.touching().size(), 18u);
  EXPECT_NEAR(made.mass_kg(), 9 * 0.12 * 0.02 * 0.01 * kDensity, 1e-12);
  expect_box(made, {0.94, 1.94, 3.0}, {1.06, 2.06, 3.03});
}

TEST(Tower, AFullLevelHasNoGaps) {
  const Made made(tower("levels = 2\nplanks = 6\n"));
  EXPECT_EQ(made.touching().size(), 5u + 5 + 36);
}

TEST(Tower, InThePlaneItIsCut) {
  const Made made(in_the_plane(tower("levels = 4\nplanks = 3\n")));
  EXPECT_EQ(made.bodies.count(), 1 + 3 + 1 + 3);
  EXPECT_EQ(made.touching().size(), 9u);
}

TEST(Tower, WhatCannotBeIsRefused) {
  EXPECT_THAT(error_of(tower("levels = 1\nplanks = 7\n")),
              HasSubstr("towers[0].planks: 7 side by side are 0.14 m wide"));
  EXPECT_THAT(error_of(tower("levels = 0\nplanks = 3\n")), HasSubstr("towers[0].levels: found 0"));
  EXPECT_THAT(error_of(tower("levels = 1\nplanks = 0\n")), HasSubstr("towers[0].planks: found 0"));
  expect_material_is_checked(tower("levels = 1\nplanks = 1\n"));
}

}  // namespace
}  // namespace conebench::test
