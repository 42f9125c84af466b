#include "dem/shape.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/dem/shape_helper.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using testing::Each;
using testing::SizeIs;

const dem::Piece kOpenMesh =
    dem::Mesh{{{9.0, 9.0, 9.0}, {0.1, 0.0, 0.2}, {1.0, -0.5, 0.3}, {0.4, 0.8, -0.7}}, {{1, 2, 3}}};

std::vector<dem::Piece> one_of_each() {
  std::vector<dem::Piece> pieces = one_of_each_solid();
  pieces.push_back(kOpenMesh);
  return pieces;
}

// Only what the faces refer to.
std::vector<Vector3d> corners(const dem::Polyhedron& polyhedron) {
  std::vector<Vector3d> result;
  for (const std::vector<int>& face : polyhedron.faces) {
    for (const int k : face) result.push_back(polyhedron.vertices[static_cast<std::size_t>(k)]);
  }
  return result;
}

Vector3d at(const dem::Polyhedron& polyhedron, int k) {
  return polyhedron.vertices[static_cast<std::size_t>(k)];
}

TEST(Pose, AppliesTheInnerOneFirst) {
  Draw draw(1);
  const dem::Pose outer = draw.pose(), inner = draw.pose();
  const Vector3d x = draw.normal();
  EXPECT_LT(((outer * inner) * x - outer * (inner * x)).norm(), 1e-14);
}

TEST(Shape, KnowsWhetherItHasAMesh) {
  EXPECT_FALSE((dem::Shape{"solid", {{dem::Ball{1.0}, {}}, {dem::Box{{1, 1, 1}}, {}}}}.has_mesh()));
  EXPECT_TRUE((dem::Shape{"mixed", {{dem::Ball{1.0}, {}}, {kOpenMesh, {}}}}.has_mesh()));
}

// Corners of facets lie on the surface. Of a circle of radius r they miss the extreme point by up
// to r (1 - cos(angle between them / 2)) in each of two directions; radii are below 1.
TEST(Bounds, HoldAllOfThePieceAndNoMore) {
  constexpr int kAround = 180;
  constexpr double kMissed = std::numbers::pi * std::numbers::pi / (kAround * kAround);
  for (const dem::Piece& piece : one_of_each()) {
    const std::vector<Vector3d> surface = corners(dem::facets(piece, kAround));
    for (unsigned seed = 0; seed < 20; ++seed) {
      const dem::Pose pose = Draw(seed).pose();
      const dem::Bounds bounds = dem::bounds_of(piece, pose);
      Vector3d low = Vector3d::Constant(INFINITY), high = -low;
      for (const Vector3d& point : surface) {
        low = low.cwiseMin(pose * point);
        high = high.cwiseMax(pose * point);
      }
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", piece " << piece.index());
      EXPECT_GT((low - bounds.low).minCoeff(), -1e-14);
      EXPECT_LT((low - bounds.low).maxCoeff(), kMissed);
      EXPECT_GT((bounds.high - high).minCoeff(), -1e-14);
      EXPECT_LT((bounds.high - high).maxCoeff(), kMissed);
    }
  }
}

TEST(Bounds, OfAnUnturnedPieceAreItsSizes) {
  const dem::Pose pose{{1.0, 2.0, 3.0}};
  const auto half = [&](const dem::Piece& piece) {
    const dem::Bounds bounds = dem::bounds_of(piece, pose);
    EXPECT_EQ((bounds.low + bounds.high) / 2.0, pose.position);
    return Vector3d((bounds.high - bounds.low) / 2.0);
  };
  EXPECT_EQ(half(dem::Ball{0.5}), Vector3d(0.5, 0.5, 0.5));
  EXPECT_EQ(half(dem::Box{{0.25, 0.5, 0.75}}), Vector3d(0.25, 0.5, 0.75));
  EXPECT_EQ(half(dem::Capsule{0.25, 0.5}), Vector3d(0.25, 0.25, 0.75));
  EXPECT_EQ(half(dem::Cylinder{0.25, 0.5}), Vector3d(0.25, 0.25, 0.5));
  EXPECT_EQ(half(dem::Hull{grid({0.25, 0.5, 0.75}, 2)}), Vector3d(0.25, 0.5, 0.75));
  EXPECT_EQ(half(box_mesh({0.25, 0.5, 0.75})), Vector3d(0.25, 0.5, 0.75));
}

TEST(Facets, OfASolidAreFlatTurnOutwardAndClose) {
  for (const int around : {3, 4, 7, 24}) {
    for (const dem::Piece& piece : one_of_each_solid()) {
      const dem::Polyhedron polyhedron = dem::facets(piece, around);
      SCOPED_TRACE(testing::Message() << around << " around, piece " << piece.index());
      EXPECT_TRUE(is_closed(polyhedron.faces));
      const Vector3d middle = mass_properties(piece).centre_m;
      for (const std::vector<int>& face : polyhedron.faces) {
        const Vector3d a = at(polyhedron, face[0]);
        const Vector3d normal =
            (at(polyhedron, face[1]) - a).cross(at(polyhedron, face[2]) - a).normalized();
        EXPECT_GT(normal.dot(a - middle), 0.0);
        for (const int k : face) EXPECT_NEAR(normal.dot(at(polyhedron, k) - a), 0.0, 1e-14);
      }
    }
  }
}

// Corners on the surface, so the volume comes from below; what is missing goes as the square of the
// angle between them.
TEST(Facets, TendToThePiece) {
  for (const dem::Piece& piece : {dem::Piece(dem::Ball{0.7}), dem::Piece(dem::Capsule{0.4, 0.8}),
                                  dem::Piece(dem::Cylinder{0.6, 0.35})}) {
    const dem::MassProperties exact = mass_properties(piece);
    const auto missing = [&](int around) {
      const auto found = dem::mass_properties(as_mesh(dem::facets(piece, around)));
      return Eigen::Vector2d(exact.volume_m3 - found.volume_m3,
                             (exact.inertia_m5 - found.inertia_m5).norm());
    };
    const Eigen::Vector2d coarse = missing(40), fine = missing(80), finest = missing(160);
    SCOPED_TRACE(piece.index());
    EXPECT_GT(finest.minCoeff(), 0.0);
    EXPECT_LT(finest(0), 2e-3 * exact.volume_m3);
    for (int k = 0; k < 2; ++k) {
      EXPECT_NEAR(coarse(k) / fine(k), 4.0, 0.05);
      EXPECT_NEAR(fine(k) / finest(k), 4.0, 0.05);
    }
  }
}

TEST(Facets, OfAHullOrABoxAreAllOfIt) {
  for (const dem::Piece& piece : one_of_each_solid()) {
    if (!std::holds_alternative<dem::Hull>(piece) && !std::holds_alternative<dem::Box>(piece)) {
      continue;
    }
    const double volume = mass_properties(piece).volume_m3;
    EXPECT_NEAR(mass_properties(as_mesh(dem::facets(piece, 8))).volume_m3, volume, 1e-14 * volume);
  }
}

TEST(Facets, OfTheHullOfABoxAreSixHoweverItIsTurned) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const dem::Hull hull{moved(grid({0.3, 0.5, 0.9}, 4), Draw(seed).pose())};
    const dem::Polyhedron polyhedron = dem::facets(hull, 8);
    EXPECT_THAT(polyhedron.faces, SizeIs(6));
    EXPECT_THAT(polyhedron.faces, Each(SizeIs(4)));
    EXPECT_TRUE(is_closed(polyhedron.faces));
  }
}

TEST(Facets, OfTheHullOfACylinderAreItsEndsAndSides) {
  const dem::Polyhedron cylinder = dem::facets(dem::Cylinder{0.6, 0.35}, 12);
  for (unsigned seed = 0; seed < 20; ++seed) {
    const dem::Hull hull{moved(cylinder.vertices, Draw(seed).pose())};
    const dem::Polyhedron polyhedron = dem::facets(hull, 8);
    EXPECT_THAT(polyhedron.faces, SizeIs(14));
    EXPECT_TRUE(is_closed(polyhedron.faces));
  }
}

TEST(Facets, OfAMeshAreItsTriangles) {
  const dem::Polyhedron polyhedron = dem::facets(kOpenMesh, 8);
  EXPECT_EQ(polyhedron.faces, (std::vector<std::vector<int>>{{1, 2, 3}}));
  EXPECT_THAT(polyhedron.vertices, SizeIs(4));
}

}  // namespace
}  // namespace conebench::test
