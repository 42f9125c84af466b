#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <set>

#include "dem/orientation.h"
#include "dem/shape.h"
#include "tests/dem/shape_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

using Points = std::vector<Vector3d>;
using Triangles = std::vector<Vector3i>;

Vector3d at(const Points& points, int k) { return points[static_cast<std::size_t>(k)]; }

std::set<int> corners_of(const Triangles& triangles) {
  std::set<int> corners;
  for (const Vector3i& triangle : triangles) corners.insert(triangle.begin(), triangle.end());
  return corners;
}

double extent_of(const Points& points) {
  Vector3d low = points.front(), high = points.front();
  for (const Vector3d& point : points) {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  return (high - low).norm();
}

// How far a point lies outside of a triangle's plane.
double most_outside(const Points& points, const Triangles& triangles) {
  double most = 0.0;
  for (const Vector3i& t : triangles) {
    const Vector3d origin = at(points, t(0));
    const Vector3d normal =
        (at(points, t(1)) - origin).cross(at(points, t(2)) - origin).normalized();
    for (const Vector3d& point : points) most = std::max(most, normal.dot(point - origin));
  }
  return most;
}

void expect_sound(const Points& points, const Triangles& triangles) {
  std::vector<std::vector<int>> faces;
  for (const Vector3i& t : triangles) faces.push_back({t(0), t(1), t(2)});
  EXPECT_TRUE(is_closed(faces));
  // Euler: V - E + F = 2, where E = 3/2 F.
  EXPECT_EQ(2 * corners_of(triangles).size(), triangles.size() + 4);
  EXPECT_LT(most_outside(points, triangles), 1e-12 * extent_of(points));
}

enum class Cloud { kBall, kSphere, kThin, kFar, kSmall, kRough, kTurnedRough };

Points cloud(Cloud kind, Draw& draw, int count) {
  Points points;
  const Eigen::Quaterniond turn = draw.turn();
  for (int k = 0; k < count; ++k) {
    const Vector3d x = draw.normal();
    switch (kind) {
      case Cloud::kBall:
        points.push_back(x);
        break;
      case Cloud::kSphere:
        points.push_back(x.normalized());
        break;
      case Cloud::kThin:
        points.emplace_back(x.x(), x.y(), 1e-6 * x.z());
        break;
      case Cloud::kFar:
        points.emplace_back(x + Vector3d(100.0, -300.0, 50.0));
        break;
      case Cloud::kSmall:
        points.emplace_back(1e-4 * x);
        break;
      case Cloud::kRough:
        points.emplace_back((4.0 * x).array().round());
        break;
      case Cloud::kTurnedRough:
        points.push_back(turn * Vector3d((4.0 * x).array().round()));
        break;
    }
  }
  return points;
}

class Clouds : public testing::TestWithParam<Cloud> {};

TEST_P(Clouds, LieInsideOfTheirHull) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Draw draw(seed);
    const Points points =
        cloud(GetParam(), draw, seed == 0 ? 1000 : 12 + 7 * static_cast<int>(seed));
    SCOPED_TRACE(seed);
    expect_sound(points, dem::hull_triangles(points));
  }
}

INSTANTIATE_TEST_SUITE_P(Hull, Clouds,
                         testing::Values(Cloud::kBall, Cloud::kSphere, Cloud::kThin, Cloud::kFar,
                                         Cloud::kSmall, Cloud::kRough, Cloud::kTurnedRough));

// Every three points that have all others on one side, turned so that they are behind.
std::set<std::array<int, 3>> supporting_triples(const Points& points) {
  const int count = static_cast<int>(points.size());
  std::set<std::array<int, 3>> triples;
  for (int i = 0; i < count; ++i) {
    for (int j = 0; j < count; ++j) {
      for (int k = 0; k < count; ++k) {
        if (i >= j || i >= k || j == k) continue;
        const Vector3d normal =
            (at(points, j) - at(points, i)).cross(at(points, k) - at(points, i));
        const bool supports = std::ranges::all_of(points, [&](const Vector3d& point) {
          return normal.dot(point - at(points, i)) < 1e-12;
        });
        if (supports) triples.insert({i, j, k});
      }
    }
  }
  return triples;
}

TEST(Hull, IsWhatTryingAllTriplesFinds) {
  for (unsigned seed = 0; seed < 30; ++seed) {
    Draw draw(seed);
    const Points points = cloud(Cloud::kBall, draw, 14);
    std::set<std::array<int, 3>> found;
    for (const Vector3i& t : dem::hull_triangles(points)) {
      std::array<int, 3> triple = {t(0), t(1), t(2)};
      std::ranges::rotate(triple, std::ranges::min_element(triple));
      found.insert(triple);
    }
    EXPECT_EQ(found, supporting_triples(points)) << "seed " << seed;
  }
}

TEST(Hull, HasAllPointsOfASphereAsCorners) {
  Draw draw(1);
  const Points points = cloud(Cloud::kSphere, draw, 1000);
  EXPECT_THAT(corners_of(dem::hull_triangles(points)), SizeIs(1000));
}

TEST(Hull, OfAGridInABoxIsTheBoxHoweverItIsTurned) {
  const Points points = grid({0.3, 0.5, 0.9}, 5);
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Points turned = seed == 0 ? points : moved(points, Draw(seed).pose());
    const Triangles triangles = dem::hull_triangles(turned);
    SCOPED_TRACE(seed);
    EXPECT_THAT(triangles, SizeIs(12));
    EXPECT_THAT(corners_of(triangles), ElementsAre(0, 4, 20, 24, 100, 104, 120, 124));
    expect_sound(turned, triangles);
  }
}

TEST(Hull, OfATurnedPrismHasItsCornersAlone) {
  constexpr int kSides = 12;
  Points points;
  for (int level = 0; level < 3; ++level) {
    for (int k = 0; k < kSides; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / kSides;
      points.emplace_back(std::cos(angle), std::sin(angle), level);
    }
  }
  for (unsigned seed = 0; seed < 30; ++seed) {
    const Points turned = moved(points, Draw(seed).pose());
    const Triangles triangles = dem::hull_triangles(turned);
    const std::set<int> corners = corners_of(triangles);
    SCOPED_TRACE(seed);
    EXPECT_THAT(corners, SizeIs(2 * kSides));
    EXPECT_TRUE(std::ranges::none_of(corners, [](int k) { return k / kSides == 1; }));
    expect_sound(turned, triangles);
  }
}

TEST(Hull, TakesRepeatedPointsOnce) {
  Draw draw(3);
  Points points = cloud(Cloud::kSphere, draw, 40);
  points.insert(points.end(), points.begin(), points.begin() + 40);
  const Triangles triangles = dem::hull_triangles(points);
  EXPECT_THAT(corners_of(triangles), SizeIs(40));
  expect_sound(points, triangles);
}

TEST(Hull, IsEmptyWherePointsLieInAPlane) {
  EXPECT_THAT(dem::hull_triangles({}), IsEmpty());
  EXPECT_THAT(dem::hull_triangles({{1, 2, 3}}), IsEmpty());
  EXPECT_THAT(dem::hull_triangles(Points(9, Vector3d(1, 2, 3))), IsEmpty());
  for (unsigned seed = 0; seed < 10; ++seed) {
    Draw draw(seed);
    const dem::Pose pose = draw.pose();
    Points line, plane;
    for (int k = 0; k < 30; ++k) {
      line.push_back(pose * Vector3d(draw.uniform(), 0.0, 0.0));
      plane.push_back(pose * Vector3d(draw.uniform(), draw.uniform(), 1e-11 * draw.uniform()));
    }
    EXPECT_THAT(dem::hull_triangles(line), IsEmpty());
    EXPECT_THAT(dem::hull_triangles(plane), IsEmpty());
  }
}

TEST(Hull, OfAThinBoxIsNotEmpty) {
  EXPECT_THAT(dem::hull_triangles(grid({1.0, 1.0, 1e-8}, 2)), SizeIs(12));
}

using Integers = Eigen::Matrix<std::int64_t, 3, 1>;

// Corners of a triangle so thin, and so long, that rounded arithmetic says nothing of the side:
// with c = a + 2 u + s the normal is u x s, where u has 46 bits and s two. All numbers are integers
// below 2^53.
TEST(Orientation, IsExact) {
  std::mt19937_64 generator(7);
  const auto draw = [&](std::int64_t limit) {
    return Integers::NullaryExpr([&] {
             return std::uniform_int_distribution<std::int64_t>(-limit, limit)(generator);
           })
        .eval();
  };
  int sides = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const Integers a = draw(std::int64_t{1} << 48), u = draw(std::int64_t{1} << 46), s = draw(3);
    const Integers in_plane = draw(2);
    const int axis = trial % 3;
    const std::int64_t nudge = trial / 3 % 3 - 1;
    Integers d = a + in_plane(0) * u + in_plane(1) * (2 * u + s);
    d(axis) += nudge;
    const std::int64_t side = nudge * u.cross(s)(axis);
    const Vector3d A = a.cast<double>(), B = (a + u).cast<double>(),
                   C = (a + 2 * u + s).cast<double>(), D = d.cast<double>();
    const int expected = (side > 0) - (side < 0);
    ASSERT_EQ(dem::orientation(A, B, C, D), expected) << "trial " << trial;
    ASSERT_EQ(dem::orientation(B, C, A, D), expected);
    ASSERT_EQ(dem::orientation(B, A, C, D), -expected);
    ASSERT_EQ(dem::orientation(A, B, D, C), -expected);
    sides += std::abs(expected);
  }
  EXPECT_GT(sides, 1000);  // two thirds, but for normals that have no such component
}

TEST(Orientation, IsPositiveWhereTheTriangleTurnsAnticlockwise) {
  const Vector3d a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_EQ(dem::orientation(a, b, c, {0.2, 0.3, 1e-20}), 1);
  EXPECT_EQ(dem::orientation(a, b, c, {0.2, 0.3, -1e-20}), -1);
  EXPECT_EQ(dem::orientation(a, b, c, {0.2, 0.3, 0.0}), 0);
}

}  // namespace
}  // namespace conebench::test
