#include <gtest/gtest.h>

#include <cmath>

#include "narrow_phase_helper.h"

namespace conebench::dem::test {
namespace {

using Eigen::Vector3d;

const Vector3d kUp = Vector3d::UnitZ();

/// The surface z = height(x, y) over [-3, 3]^2, by squares of side 0.25 cut in two.
template <class Height>
Mesh surface(const Height& height) {
  constexpr int count = 24;
  Mesh mesh;
  for (int j = 0; j <= count; ++j) {
    for (int i = 0; i <= count; ++i) {
      const double x = -3.0 + 0.25 * i, y = -3.0 + 0.25 * j;
      mesh.vertices_m.push_back({x, y, height(x, y)});
    }
  }
  for (int j = 0; j < count; ++j) {
    for (int i = 0; i < count; ++i) {
      const int corner = j * (count + 1) + i, across = corner + count + 2;
      mesh.triangles.push_back({corner, corner + 1, across});
      mesh.triangles.push_back({corner, across, corner + count + 1});
    }
  }
  return mesh;
}

Mesh flat() {
  return surface([](double, double) { return 0.0; });
}

TEST(MeshTouches, ABallRollingOverAFlatMeshSeesOneTouchAndItsNormal) {
  PiecePair pair(Ball{0.1}, flat());
  for (const double side : {1.0, -1.0}) {
    for (const double gap : {1e-4, 0.0, -1e-4, -0.09}) {
      for (int k = 0; k < 200; ++k) {
        const Vector3d centre(-1.0 + 0.0125 * k, 0.25 + 0.003 * k, side * (0.1 + gap));
        const auto touches = pair.touches(at(centre), at({0, 0, 0}), 1e-2);
        ASSERT_EQ(touches.size(), 1u);
        EXPECT_TRUE(has(touches, {centre.x(), centre.y(), 0.5 * gap * side}, side * kUp, gap));
      }
    }
  }
}

TEST(MeshTouches, ABallOnARidgeSeesTheEdgeAndInAValleyBothSides) {
  const double slope = 0.5, cosine = 1.0 / std::hypot(1.0, slope);
  const Mesh ridge = surface([&](double x, double) { return -slope * std::abs(x); });
  const Mesh valley = surface([&](double x, double) { return slope * std::abs(x); });
  const auto above = touches_of(Ball{0.1}, at({0, 0.1, 0.1}), ridge, at({0, 0, 0}), 1e-3);
  ASSERT_EQ(above.size(), 1u);
  EXPECT_TRUE(has(above, {0, 0.1, 0}, kUp, 0.0));
  const auto between =
      touches_of(Ball{0.1}, at({0, 0.1, 0.1 / cosine}), valley, at({0, 0, 0}), 1e-3);
  ASSERT_EQ(between.size(), 2u);
  for (const double side : {-1.0, 1.0}) {
    const Vector3d normal(-side * slope * cosine, 0, cosine);
    EXPECT_TRUE(has(between, Vector3d(0, 0.1, 0.1 / cosine) - 0.1 * normal, normal, 0.0));
  }
}

TEST(MeshTouches, ABoxSlidingOverAFlatMeshTouchesAtItsFourCornersOnly) {
  PiecePair pair(Box{{0.6, 0.4, 0.3}}, flat());
  Random random(1);
  for (const double gap : {1e-4, 0.0, -1e-9, -1e-4, -1e-2}) {
    for (int k = 0; k < 60; ++k) {
      const Vector3d centre(random.uniform(-1.5, 1.5), random.uniform(-1.5, 1.5), 0.3 + gap);
      const auto turn = turned(k % 3 == 0 ? 0.0 : random.uniform(0.0, 3.0), kUp);
      const auto touches = pair.touches(at(centre, turn), at({0, 0, 0}), 1e-3);
      ASSERT_EQ(touches.size(), 4u) << gap << " " << k;
      for (const double x : {-0.6, 0.6}) {
        for (const double y : {-0.4, 0.4}) {
          Vector3d corner = centre + turn * Vector3d(x, y, 0);
          corner.z() = 0.5 * gap;
          EXPECT_TRUE(has(touches, corner, kUp, gap));
        }
      }
    }
  }
}

TEST(MeshTouches, ABoxTiltedOverAFlatMeshSeesFaceNormalsAndTheGapsOfItsCorners) {
  const Mesh mesh = flat();
  const Box box{{0.6, 0.4, 0.3}};
  for (const double tilt : {1e-6, 1e-3, 0.1}) {
    const auto turn = turned(tilt, Vector3d(1, 2, 0).normalized());
    double low = 0.0, high = 1.0;
    for (const double x : {-0.6, 0.6}) {
      for (const double y : {-0.4, 0.4}) {
        low = std::max(low, -(turn * Vector3d(x, y, -0.3)).z());
        high = std::min(high, -(turn * Vector3d(x, y, -0.3)).z());
      }
    }
    const auto touches =
        touches_of(box, at({0.07, 0.03, low - 1e-5}, turn), mesh, at({0, 0, 0}), 0.5);
    ASSERT_EQ(touches.size(), 4u);
    for (const Touch& touch : touches) EXPECT_EQ(touch.normal, kUp);
    EXPECT_NEAR(nearest(touches).gap, -1e-5, 1e-9);
    const auto farthest = std::max_element(
        touches.begin(), touches.end(), [](const auto& a, const auto& b) { return a.gap < b.gap; });
    EXPECT_NEAR(farthest->gap, low - high - 1e-5, 1e-9);
  }
}

TEST(MeshTouches, ABoxThatOverhangsTheMeshTouchesAtItsRim) {
  const auto touches =
      touches_of(Box{{0.6, 0.4, 0.3}}, at({2.8, 0, 0.3}), flat(), at({0, 0, 0}), 1e-3);
  for (const double y : {-0.4, 0.4}) {
    EXPECT_TRUE(has(touches, {2.2, y, 0}, kUp, 0.0));
    EXPECT_TRUE(has(touches, {3.0, y, 0}, kUp, 0.0));
  }
  for (const Touch& touch : touches) EXPECT_EQ(touch.normal, kUp);
}

TEST(MeshTouches, ABoxOnAMildRidgeRestsOnItsEdge) {
  const Mesh ridge = surface([](double x, double) { return -0.01 * std::abs(x); });
  const auto touches =
      touches_of(Box{{0.6, 0.4, 0.3}}, at({0, 0, 0.3}), ridge, at({0, 0, 0}), 1e-3);
  ASSERT_FALSE(touches.empty());
  for (const Touch& touch : touches) {
    EXPECT_LT((touch.normal - kUp).norm(), 0.011);
    EXPECT_GT(touch.gap, -1e-12);
  }
  for (const double y : {-0.4, 0.4}) EXPECT_TRUE(has(touches, {0, y, 0}, kUp, 0.0));
}

TEST(MeshTouches, CapsulesAndCylindersOnAFlatMeshTouchAsOnABox) {
  const Mesh mesh = flat();
  const Box floor{{3.0, 3.0, 1.0}};
  const auto lying = turned(1.5707963267948966, Vector3d(1.0, 0.3, 0.0).normalized());
  for (const double gap : {1e-4, 0.0, -1e-4}) {
    const auto compare = [&](const Piece& piece, const Pose& pose, std::size_t count) {
      const auto on_mesh = touches_of(piece, pose, mesh, at({0, 0, 0}), 1e-3);
      const auto on_box = touches_of(piece, pose, floor, at({0, 0, -1.0}), 1e-3);
      ASSERT_EQ(on_mesh.size(), count);
      for (const Touch& touch : on_box) {
        EXPECT_TRUE(has(on_mesh, touch.point, touch.normal, touch.gap));
      }
    };
    compare(Capsule{0.2, 0.7}, at({0.03, 0.07, 0.2 + gap}, lying), 2);
    compare(Cylinder{0.2, 0.7}, at({0.03, 0.07, 0.2 + gap}, lying), 2);
    compare(Cylinder{0.4, 0.3}, at({0.03, 0.07, 0.3 + gap}, turned(0.2, kUp)), 4);
  }
}

TEST(MeshTouches, ABoxOnAStepSeesNoNormalOfItsWall) {
  // A step's top, wall and bottom: the box overlaps the top of the wall a little.
  const Mesh step{{{-2, -2, 0}, {0, -2, 0}, {0, 2, 0}, {-2, 2, 0}, {0, -2, -1}, {0, 2, -1}},
                  {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}}};
  for (const double tilt : {0.0, 1e-6, 1e-3, -1e-3}) {
    const auto touches =
        touches_of(Box{{0.5, 0.5, 0.5}}, at({-0.2, 0, 0.5 - 1e-5}, turned(tilt, Vector3d::UnitY())),
                   step, at({0, 0, 0}), 1e-3);
    ASSERT_GE(touches.size(), 2u);
    for (const Touch& touch : touches) {
      EXPECT_LT((touch.normal - kUp).norm(), 1.1e-3);
      EXPECT_GT(touch.gap, -1e-3);
    }
  }
}

// Below the bottom of a valley a tip stands on neither side.
TEST(MeshTouches, ATipThatHasGoneThroughAValleyIsPushedOut) {
  const Mesh valley = surface([](double x, double) { return 0.5 * std::abs(x); });
  const Hull tip{{{0, 0, 0}, {0.1, 0, 1}, {-0.05, 0.08, 1}, {-0.05, -0.08, 1}}};
  PiecePair pair(tip, valley);
  for (const double depth : {1e-6, 1e-3, 2e-2}) {
    for (const double y : {0.1, 0.125, 0.25}) {
      const auto touches = pair.touches(at({0, y, -depth}), at({0, 0, 0}), 1e-3);
      ASSERT_FALSE(touches.empty());
      EXPECT_GT(nearest(touches).normal.z(), 0.5);
      EXPECT_LT(nearest(touches).gap, 0.0);
      EXPECT_GT(nearest(touches).gap, -1.01 * depth);
    }
  }
}

TEST(MeshTouches, TheMeshMayComeFirstAndBeAnywhere) {
  const Mesh mesh = flat();
  const Box box{{0.6, 0.4, 0.3}};
  Random random(2);
  const Pose motion = at(1e3 * random.vector(), random.turn());
  const Pose pose = at({0.1, 0.2, 0.3 + 1e-4}, turned(0.4, kUp));
  const auto expected = touches_of(box, pose, mesh, at({0, 0, 0}), 1e-3);
  const auto moved = touches_of(mesh, motion, box, motion * pose, 1e-3);
  ASSERT_EQ(moved.size(), expected.size());
  for (const Touch& touch : expected) {
    EXPECT_TRUE(has(moved, motion * touch.point, -(motion.orientation * touch.normal), touch.gap));
  }
  EXPECT_TRUE(touches_of(box, at({0, 0, 0.302}), mesh, at({0, 0, 0}), 1e-3).empty());
}

TEST(MeshTouches, ABallOverACurvedMeshSeesTheLeastDistance) {
  const Mesh mesh =
      surface([](double x, double y) { return 0.2 * std::sin(x) * std::cos(1.3 * y); });
  PiecePair pair(Ball{0.1}, mesh);
  Random random(3);
  for (int k = 0; k < 100; ++k) {
    const Vector3d centre(random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(0.2, 0.6));
    double least = 1e9;
    for (const auto& t : mesh.triangles) {
      // By a grid on the triangle, made finer about its best point.
      const auto corner = [&](int c) { return mesh.vertices_m[static_cast<std::size_t>(t(c))]; };
      const Vector3d a = corner(0), u = corner(1) - a, v = corner(2) - a;
      if ((a - centre).norm() - 0.5 > least) continue;
      double s = 0.5, r = 0.25;
      for (double step = 0.25; step > 1e-12; step *= 0.5) {
        double best = 1e9, best_s = s, best_r = r;
        for (int i = -2; i <= 2; ++i) {
          for (int j = -2; j <= 2; ++j) {
            const double ss = std::clamp(s + i * step, 0.0, 1.0);
            const double rr = std::clamp(r + j * step, 0.0, 1.0 - ss);
            const double here = (a + ss * u + rr * v - centre).norm();
            if (here < best) best = here, best_s = ss, best_r = rr;
          }
        }
        s = best_s, r = best_r;
        least = std::min(least, best);
      }
    }
    const auto touches = pair.touches(at(centre), at({0, 0, 0}), 10.0);
    EXPECT_NEAR(nearest(touches).gap, least - 0.1, 1e-9);
  }
}

}  // namespace
}  // namespace conebench::dem::test
