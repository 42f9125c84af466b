// The order in which a picture is painted.

#include "dem/paint_order.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <numbers>
#include <tuple>

#include "dem/seen_faces.h"
#include "tests/dem/shape_helper.h"

namespace conebench::test {
namespace {

using dem::Contour;
using dem::Patch;
using Eigen::Vector2d;
using Eigen::Vector3d;
using testing::ElementsAre;

// The rectangle between two corners, at depth x . slope.
Patch rectangle(const Vector2d& low, const Vector2d& high, const Vector3d& slope) {
  Patch patch;
  patch.contour = {low, {low[0], high[1]}, high, {high[0], low[1]}};
  patch.slope = slope;
  std::vector<double> depths;
  for (const Vector2d& x : patch.contour) depths.push_back(patch.plane_depth(x));
  std::tie(patch.farthest, patch.nearest) =
      std::minmax({depths[0], depths[1], depths[2], depths[3]});
  return patch;
}

TEST(PaintOrder, LevelThingsComeByTheirDepth) {
  const Vector2d low(0, 0), high(10, 10);
  const std::vector<Patch> patches{rectangle(low, high, {0, 0, 3}), rectangle(low, high, {0, 0, 1}),
                                   rectangle(low, high, {0, 0, 2})};
  EXPECT_THAT(dem::paint_order(patches), ElementsAre(1, 2, 0));
}

// A wall that comes from far behind to far in front, with its middle in front of the card; but
// where the card is, the wall is behind it.
TEST(PaintOrder, ThingsAreComparedWhereTheyOverlap) {
  const Patch wall = rectangle({0, 0}, {100, 100}, {1.0, 0, -20});
  const Patch card = rectangle({10, 40}, {20, 50}, {0, 0, 15});
  EXPECT_THAT(dem::paint_order(std::vector{wall, card}), ElementsAre(0, 1));
  EXPECT_THAT(dem::paint_order(std::vector{card, wall}), ElementsAre(1, 0));
}

// At their edge the left one is nearer, though its middle is not; but it covers nothing there.
TEST(PaintOrder, NeighboursThatShareAnEdgeHideNothing) {
  const Patch left = rectangle({0, 0}, {10, 10}, {1.0, 0, 0});
  const Patch right = rectangle({10, 0}, {20, 10}, {0.0, 0, 8});
  EXPECT_THAT(dem::paint_order(std::vector{left, right}), ElementsAre(0, 1));
  EXPECT_THAT(dem::paint_order(std::vector{right, left}), ElementsAre(1, 0));
}

// Three sticks, each on the next one: along the top, down the left, and from end to end of these.
// No order is right; it begins with the farthest, as if that covered nothing.
TEST(PaintOrder, ARingIsCutAtItsFarthest) {
  const Patch top = rectangle({0, 0}, {100, 10}, {-0.1, 0, 0});
  const Patch left = rectangle({0, 0}, {10, 100}, {0, 0.1, -5});
  Patch slanting;
  slanting.contour = {{0, 90}, {10, 100}, {100, 10}, {90, 0}};
  EXPECT_THAT(dem::paint_order(std::vector{top, left, slanting}), ElementsAre(0, 2, 1));
  EXPECT_THAT(dem::paint_order(std::vector{slanting, left, top}), ElementsAre(2, 0, 1));
}

TEST(PaintOrder, ClippingKeepsWhatIsInside) {
  const Contour square{{0, 0}, {0, 10}, {10, 10}, {10, 0}};
  EXPECT_EQ(dem::area(square), 100.0);
  EXPECT_NEAR(dem::area(dem::clipped({{5, 5}, {5, 20}, {20, 20}, {20, 5}}, square)), 25.0, 1e-12);
  EXPECT_TRUE(dem::clipped({{11, 0}, {11, 5}, {15, 5}}, square).empty());
  EXPECT_EQ(dem::clipped({{3, 3}}, square).size(), 1u);
  EXPECT_TRUE(dem::clipped({{3, 11}}, square).empty());
}

// A tower of planks, turned at random, which has a right order from all sides, but not that of the
// middles of faces: at every pixel, what is painted last is what is nearest.
class TurnedTower : public testing::TestWithParam<unsigned> {};

TEST_P(TurnedTower, TheNearestIsPaintedLastEverywhere) {
  Draw draw(GetParam());
  std::vector<dem::Piece> pieces;
  const dem::Shape shape{"plank", {{dem::Box{{3.0, 0.6, 0.2}}, {}}}};
  const std::vector<dem::Solid> solids{dem::make_solid(shape, pieces)};
  engine::Window window;
  window.axes = engine::oblique_axes({0, 0, -9.81});
  window.low.setConstant(-5.0);
  window.high.setConstant(5.0);
  const engine::Camera camera(window);
  const dem::SeenFaces faces(solids, camera.scale());

  std::vector<Patch> patches;
  const dem::Pose tower{Vector3d::Zero(), draw.turn()};
  for (int k = 0; k < 30; ++k) {
    const double aside = 2.0 * (k % 3) - 2.0, height = 0.4 * (k / 3) - 1.8;
    const bool across = k / 3 % 2 == 1;
    const dem::Pose plank{across ? Vector3d(aside, 0, height) : Vector3d(0, aside, height),
                          Eigen::Quaterniond(Eigen::AngleAxisd(
                              across ? 0.5 * std::numbers::pi : 0.0, Vector3d::UnitZ()))};
    for (auto& face : faces.of(0, tower * plank, camera, Vector3d::Zero())) {
      patches.push_back(std::move(face.patch));
    }
  }
  ASSERT_EQ(patches.size(), 90u);
  const std::vector<int> order = dem::paint_order(patches);

  int covered = 0;
  for (double x = 2.5; x < camera.width_px(); x += 10.0) {
    for (double y = 2.5; y < camera.height_px(); y += 10.0) {
      double painted = 0.0, nearest = -1e9;
      for (const int i : order) {
        const Patch& patch = patches[static_cast<std::size_t>(i)];
        if (dem::clipped({{x, y}}, patch.contour).empty()) continue;
        painted = patch.depth({x, y});
        nearest = std::max(nearest, painted);
      }
      if (nearest < -1e8) continue;
      ++covered;
      // Planks touch: where two faces meet, either may be on top.
      EXPECT_NEAR(painted, nearest, 0.1) << x << ", " << y;
    }
  }
  EXPECT_GT(covered, 500);
}

INSTANTIATE_TEST_SUITE_P(PaintOrder, TurnedTower, testing::Range(0u, 8u));

}  // namespace
}  // namespace conebench::test
