#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/dem/generators/made.h"
#include "tests/engine/scene_text.h"

namespace conebench::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// With a ball on the axis, which sees all walls.
std::string hopper(double height, const std::string& keys) {
  return made_head() + "[[bodies]]\nposition_m = [0, 0, " + std::to_string(height) +
         "]\nradius_m = 0.01\n" + kStone +
         "[[hoppers]]\noutlet_m = 0.1\ntop_m = 0.4\nheight_m = 0.2\nwall_m = 0.02\n" + keys +
         kStone;
}

std::vector<double> gaps_of_ball(const Made& made) {
  std::vector<double> gaps;
  for (const dem::Near& near : made.near_within(0.2)) gaps.push_back(near.touch.gap);
  std::sort(gaps.begin(), gaps.end());
  return gaps;
}

// Half way up the inner face is 0.125 m from the axis, 0.125 cos(atan(0.15 / 0.2)) = 0.1 m along
// its normal.
TEST(Hopper, AllStavesOfAConeAreAsFarFromTheAxis) {
  const Made made(hopper(0.1, "staves = 12\n"));
  EXPECT_EQ(made.bodies.count(), 2);
  EXPECT_FALSE(made.bodies.is_free(1));
  const std::vector<double> gaps = gaps_of_ball(made);
  ASSERT_EQ(gaps.size(), 12u);
  for (const double gap : gaps) EXPECT_NEAR(gap, 0.09, 1e-12);
}

TEST(Hopper, AWedgeHasTwoInclinedWallsAndTwoEnds) {
  const std::string text = hopper(0.1, "form = \"wedge\"\nlength_m = 0.3\n");
  std::vector<double> gaps = gaps_of_ball(Made(text));
  ASSERT_EQ(gaps.size(), 4u);
  for (const std::size_t k : {0, 1}) EXPECT_NEAR(gaps[k], 0.09, 1e-12);
  for (const std::size_t k : {2, 3}) EXPECT_NEAR(gaps[k], 0.14, 1e-12);
  gaps = gaps_of_ball(Made(in_the_plane(text)));
  ASSERT_EQ(gaps.size(), 2u);
  for (const double gap : gaps) EXPECT_NEAR(gap, 0.09, 1e-12);
}

TEST(Hopper, ALidClosesTheOutletUntilItsMotionOpensIt) {
  const Made shut(hopper(0.01, "lid = true\n"));
  EXPECT_EQ(shut.bodies.count(), 3);
  EXPECT_NEAR(gaps_of_ball(shut).front(), 0.0, 1e-12);
  EXPECT_TRUE(shut.placement.driven.empty());
  const Made door(hopper(0.01, "lid = true\nlid_motion = \"turn\"\n"));
  ASSERT_EQ(door.placement.driven.size(), 1u);
  EXPECT_EQ(door.placement.driven[0].body, 2);
}

TEST(Hopper, WhatCannotBeIsRefused) {
  EXPECT_THAT(error_of(changed(hopper(0.1, ""), "top_m = 0.4", "top_m = 0.05")),
              HasSubstr("hoppers[0].top_m: found 0.05, expected >= outlet_m = 0.1"));
  EXPECT_THAT(error_of(hopper(0.1, "staves = 2\n")), HasSubstr("hoppers[0].staves: found 2"));
  EXPECT_THAT(error_of(hopper(0.1, "lid_motion = \"turn\"\n")),
              HasSubstr("lid_motion: unknown key"));
  EXPECT_THAT(error_of(hopper(0.1, "lid = true\nlid_motion = \"tun\"\n")),
              AllOf(HasSubstr("hoppers: lid_motion: no motion \"tun\""), HasSubstr("'turn'")));
  EXPECT_THAT(error_of(in_the_plane(hopper(0.1, ""))),
              HasSubstr("hoppers: form: found cone, expected wedge"));
  EXPECT_THAT(error_of(hopper(0.005, "lid = true\n")),
              HasSubstr("body 0 and body 2 overlap by 0.005"));
  expect_material_is_checked(hopper(0.1, ""));
}

std::string drum(const std::string& keys) {
  return made_head() + "[[bodies]]\nposition_m = [0, 0, 0]\nradius_m = 0.01\n" + kStone +
         "[[drums]]\nradius_m = 0.12\nlength_m = 0.2\nwall_m = 0.02\nstaves = 16\n" + keys + kStone;
}

TEST(Drum, StavesTouchTheCylinderAndPlatesCloseTheEnds) {
  const Made made(drum("motion = \"turn\"\n"));
  EXPECT_EQ(made.bodies.count(), 2);
  EXPECT_EQ(made.placement.driven.size(), 1u);
  std::vector<double> gaps = gaps_of_ball(made);
  ASSERT_EQ(gaps.size(), 18u);
  for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(gaps[k], 0.09, 1e-12);
  for (std::size_t k = 2; k < 18; ++k) EXPECT_NEAR(gaps[k], 0.11, 1e-12);
  gaps = gaps_of_ball(Made(in_the_plane(drum(""))));
  ASSERT_EQ(gaps.size(), 16u);
  for (const double gap : gaps) EXPECT_NEAR(gap, 0.11, 1e-12);
}

TEST(Drum, WhatCannotBeIsRefused) {
  EXPECT_THAT(error_of(changed(drum(""), "staves = 16", "staves = 2")),
              HasSubstr("drums[0].staves: found 2"));
  EXPECT_THAT(error_of(drum("motion = \"tun\"\n")),
              AllOf(HasSubstr("drums: no motion \"tun\""), HasSubstr("'turn'")));
  EXPECT_THAT(error_of(changed(drum(""), "radius_m = 0.12", "radius_m = 0.009")),
              HasSubstr("overlap"));
  expect_material_is_checked(drum(""));
}

}  // namespace
}  // namespace conebench::test
