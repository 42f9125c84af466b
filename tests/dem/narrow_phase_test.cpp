#include "dem/narrow_phase.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "narrow_phase_helper.h"
#include "narrow_phase_oracle.h"
#include "problems/error.h"

namespace conebench::dem::test {
namespace {

using Eigen::Vector3d;

constexpr double kAll = 100.0;  // a reach that leaves nothing out
constexpr int kKinds = 4;       // of Random::piece

struct Pair {
  Piece first, second;
  Pose first_pose, second_pose;

  std::vector<Touch> touches(double reach) const {
    return touches_of(first, first_pose, second, second_pose, reach);
  }
};

Pair apart_pair(Random& random, int first_kind, int second_kind) {
  return {random.piece(first_kind), random.piece(second_kind),
          at(10.0 * random.direction(), random.turn()), at({0, 0, 0}, random.turn())};
}

// Moved together along the normal until the gap is as wanted.
Pair pair_at_gap(Random& random, int first_kind, int second_kind, double gap) {
  Pair pair = apart_pair(random, first_kind, second_kind);
  const Touch touch = nearest(pair.touches(kAll));
  pair.first_pose.position += (gap - touch.gap) * touch.normal;
  return pair;
}

Touch ball_touch(const Vector3d& centre, double radius, const Piece& piece, const Pose& pose) {
  const std::vector<Piece> pieces = {piece};
  std::vector<Touch> found;
  NarrowPhase(pieces).ball_touches(centre, radius, 0, pose, kAll, found);
  EXPECT_EQ(found.size(), 1u);
  return found.at(0);
}

TEST(NarrowPhase, BallsAreAsFarFromBoxesCapsulesAndCylindersAsTheFormulasSay) {
  Random random(1);
  for (int k = 0; k < 1000; ++k) {
    const Pose pose = at(random.vector(), random.turn());
    const Vector3d local = random.vector(), centre = pose * local;
    const auto expect_gap = [&](const Piece& piece, double signed_distance) {
      const Touch touch = ball_touch(centre, 0.3, piece, pose);
      EXPECT_NEAR(touch.gap, signed_distance - 0.3, 1e-12);
      const Vector3d on_piece = touch.point - 0.5 * touch.gap * touch.normal;
      EXPECT_LT((on_piece + signed_distance * touch.normal - centre).norm(), 1e-12);
      EXPECT_TRUE(holds(piece, pose, on_piece, 1e-12));
    };
    const Box box = random.box();
    const Vector3d beyond = local.cwiseAbs() - box.half_m;
    expect_gap(box, beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0));
    const Capsule capsule = random.capsule();
    const double z = std::clamp(local.z(), -capsule.half_length_m, capsule.half_length_m);
    expect_gap(capsule, (local - z * Vector3d::UnitZ()).norm() - capsule.radius_m);
    const Cylinder cylinder = random.cylinder();
    const Eigen::Vector2d out(std::hypot(local.x(), local.y()) - cylinder.radius_m,
                              std::abs(local.z()) - cylinder.half_length_m);
    expect_gap(cylinder, out.cwiseMax(0.0).norm() + std::min(out.maxCoeff(), 0.0));
  }
}

TEST(NarrowPhase, BallsAreAsFarFromHullsAsFromTheirTriangles) {
  Random random(2);
  for (int k = 0; k < 300; ++k) {
    const Piece hull = random.hull();
    const Pose pose = at(random.vector(), random.turn());
    const Vector3d centre = pose * random.vector();
    const Triangles triangles = triangles_of(hull, pose);
    double inside = -kAll;
    for (const auto& t : triangles) {
      const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
      inside = std::max(inside, normal.dot(centre - t[0]));
    }
    EXPECT_NEAR(ball_touch(centre, 0.1, hull, pose).gap,
                (inside > 0.0 ? distance_of(centre, triangles) : inside) - 0.1, 1e-12);
  }
}

TEST(NarrowPhase, CapsulesAreAsFarApartAsTheirSegments) {
  Random random(3);
  for (int k = 0; k < 1000; ++k) {
    const Capsule a = random.capsule(), b = random.capsule();
    const Pose pose_a = at(random.vector(), random.turn()), pose_b = at({0, 0, 0}, random.turn());
    const Vector3d end_a(0, 0, a.half_length_m), end_b(0, 0, b.half_length_m);
    const double distance = segment_distance(pose_a * Vector3d(-end_a), pose_a * end_a,
                                             pose_b * Vector3d(-end_b), pose_b * end_b);
    EXPECT_NEAR(nearest(touches_of(a, pose_a, b, pose_b, kAll)).gap,
                distance - a.radius_m - b.radius_m, 1e-12);
  }
}

TEST(NarrowPhase, DisjointPolyhedraAreAsFarApartAsTheirTriangles) {
  Random random(4);
  for (const double gap : {1.0, 1e-3, 1e-6, 1e-9}) {
    for (int k = 0; k < 60; ++k) {
      const Pair pair = pair_at_gap(random, k % 2 == 0 ? 0 : 3, 3, gap);
      const auto touches = pair.touches(kAll);
      EXPECT_NEAR(nearest(touches).gap,
                  distance_of(triangles_of(pair.first, pair.first_pose),
                              triangles_of(pair.second, pair.second_pose)),
                  1e-9);
    }
  }
}

TEST(NarrowPhase, PolyhedraThatOverlapComeFreeAlongTheShortestWay) {
  Random random(5);
  for (int k = 0; k < 120; ++k) {
    Pair pair = apart_pair(random, k % 2 == 0 ? 0 : 3, k % 3 == 0 ? 0 : 3);
    pair.first_pose.position = random.uniform(0.0, 0.5) * random.direction();
    const double expected = greatest_separation(triangles_of(pair.first, pair.first_pose),
                                                triangles_of(pair.second, pair.second_pose));
    if (expected > 0.0) continue;
    for (const Touch& touch : pair.touches(1e-3)) {
      EXPECT_NEAR(
          separation(pair.first, pair.first_pose, pair.second, pair.second_pose, touch.normal),
          expected, 1e-9);
      EXPECT_GT(touch.gap, expected - 1e-9);
    }
  }
}

// The gap is a lower bound of the distance, as the separation along the normal, and an upper one,
// as the distance of two points of the pieces.
TEST(NarrowPhase, OfAnyDisjointPiecesTheGapIsTheDistance) {
  Random random(6);
  for (int kinds = 0; kinds < kKinds * kKinds; ++kinds) {
    for (const double gap : {0.3, 1e-2, 1e-4, 1e-6}) {
      for (int k = 0; k < 30; ++k) {
        const Pair pair = pair_at_gap(random, kinds / kKinds, kinds % kKinds, gap);
        const Touch touch = nearest(pair.touches(kAll));
        EXPECT_NEAR(touch.gap, gap, 1e-9);
        EXPECT_NEAR(
            separation(pair.first, pair.first_pose, pair.second, pair.second_pose, touch.normal),
            touch.gap, 1e-9);
        const Vector3d half = 0.5 * touch.gap * touch.normal;
        EXPECT_TRUE(holds(pair.first, pair.first_pose, touch.point + half, 1e-9));
        EXPECT_TRUE(holds(pair.second, pair.second_pose, touch.point - half, 1e-9));
      }
    }
  }
}

// No direction of many separates better.
TEST(NarrowPhase, SlightOverlapsOfCylindersAreTheLeast) {
  Random random(7);
  for (int kinds = 0; kinds < kKinds; ++kinds) {
    for (const double gap : {-1e-6, -1e-3, -2e-2}) {
      for (int k = 0; k < 20; ++k) {
        const Pair pair = pair_at_gap(random, kinds, 2, gap);
        const auto touches = pair.touches(1e-4);
        ASSERT_FALSE(touches.empty());
        const auto along = [&](const Vector3d& normal) {
          return separation(pair.first, pair.first_pose, pair.second, pair.second_pose, normal);
        };
        const Vector3d& normal = touches[0].normal;
        EXPECT_GE(along(normal), gap - 1e-9);
        for (int m = 0; m < 300; ++m) {
          const double turn = std::pow(10.0, random.uniform(-6.0, 0.5));
          EXPECT_LE(along((normal + turn * random.direction()).normalized()), along(normal) + 1e-9);
        }
      }
    }
  }
}

// The closest points are exact to 1e-15 in distance, thus their direction, and with it the places,
// to the root of twice that.
constexpr double kPlace = 1e-7;

bool same_touches(const std::vector<Touch>& a, const std::vector<Touch>& b, double sign) {
  return a.size() == b.size() && std::all_of(a.begin(), a.end(), [&](const Touch& x) {
           return std::any_of(b.begin(), b.end(), [&](const Touch& y) {
             return (x.point - y.point).norm() < kPlace && std::abs(x.gap - y.gap) < 1e-9 &&
                    (x.normal - sign * y.normal).norm() < kPlace;
           });
         });
}

// Where the rim of a cylinder overlaps a corner, several ways out may be about as short.
bool ambiguous(int kinds, double gap) {
  return gap < 0.0 && (kinds / kKinds == 2 || kinds % kKinds == 2);
}

TEST(NarrowPhase, SwappingThePiecesTurnsTheNormalsRound) {
  Random random(8);
  for (int kinds = 0; kinds < kKinds * kKinds; ++kinds) {
    for (const double gap : {1e-3, -1e-3}) {
      for (int k = 0; k < 20 && !ambiguous(kinds, gap); ++k) {
        const Pair pair = pair_at_gap(random, kinds / kKinds, kinds % kKinds, gap);
        const auto swapped =
            touches_of(pair.second, pair.second_pose, pair.first, pair.first_pose, 0.1);
        EXPECT_TRUE(same_touches(pair.touches(0.1), swapped, -1.0)) << kinds << " " << gap;
      }
    }
  }
}

TEST(NarrowPhase, MovingBothMovesTheTouches) {
  Random random(9);
  for (int kinds = 0; kinds < kKinds * kKinds; ++kinds) {
    for (const double gap : {1e-3, -1e-3}) {
      for (int k = 0; k < 20 && !ambiguous(kinds, gap); ++k) {
        const Pair pair = pair_at_gap(random, kinds / kKinds, kinds % kKinds, gap);
        const Pose motion = at(1e3 * random.vector(), random.turn());
        auto expected = pair.touches(0.1);
        for (Touch& touch : expected) {
          touch = {motion * touch.point, motion.orientation * touch.normal, touch.gap};
        }
        const auto moved = touches_of(pair.first, motion * pair.first_pose, pair.second,
                                      motion * pair.second_pose, 0.1);
        EXPECT_TRUE(same_touches(expected, moved, 1.0)) << kinds << " " << gap;
      }
    }
  }
}

TEST(NarrowPhase, TheSameCallGivesTheSameBits) {
  Random random(10);
  std::vector<Piece> pieces;
  for (int k = 0; k < 8; ++k) pieces.push_back(random.piece(k % kKinds));
  std::vector<Pose> poses;
  for (int k = 0; k < 8; ++k) poses.push_back(at(random.vector(), random.turn()));
  NarrowPhase narrow(pieces), other(pieces);
  const auto call = [&](NarrowPhase& with, int k) {
    std::vector<Touch> found;
    with.touches(k % 8, poses[static_cast<std::size_t>(k % 8)], k / 8 % 8,
                 poses[static_cast<std::size_t>(k / 8 % 8)], 0.5, found);
    return found;
  };
  std::vector<std::vector<Touch>> first;
  for (int k = 0; k < 1024; ++k) first.push_back(call(narrow, k));
  for (int k = 1023; k >= 0; --k) {
    const auto again = call(k % 2 == 0 ? narrow : other, k);
    const auto& before = first[static_cast<std::size_t>(k)];
    ASSERT_EQ(again.size(), before.size());
    if (again.empty()) continue;  // memcmp takes no null pointer
    EXPECT_EQ(std::memcmp(again.data(), before.data(), again.size() * sizeof(Touch)), 0);
  }
}

TEST(NarrowPhase, AnyOverlapHasASaneTouch) {
  Random random(11);
  for (int k = 0; k < 1500; ++k) {
    Pair pair = apart_pair(random, k % kKinds, k / kKinds % kKinds);
    const double spread = std::pow(10.0, random.uniform(-17.0, 0.0));
    pair.first_pose = at(spread * random.vector(), random.turn());
    if (k % 3 == 0) pair.second_pose.orientation = pair.first_pose.orientation;
    if (k % 5 == 0) pair.first_pose = pair.second_pose;
    const double span = 5.0;
    for (const Touch& touch : pair.touches(0.1)) {
      EXPECT_TRUE(touch.point.allFinite());
      EXPECT_NEAR(touch.normal.norm(), 1.0, 1e-12);
      EXPECT_LT(std::abs(touch.gap), span);
      EXPECT_LT(touch.point.norm(), span);
    }
    const bool apart = separation(pair.first, pair.first_pose, pair.second, pair.second_pose,
                                  pair.first_pose.position.stableNormalized()) > 0.0;
    if (!apart && spread < 0.05) {
      EXPECT_FALSE(pair.touches(0.1).empty());
    }
  }
}

TEST(NarrowPhase, SmallAndLargePiecesAreTreatedAlike) {
  Random random(12);
  for (int kinds = 0; kinds < kKinds; ++kinds) {
    const Piece small = random.piece(kinds);
    const Pose pose = at({300.0, -200.0, 0.0}, random.turn());
    const Box floor{{1e3, 1e3, 1.0}};
    const double low = separation(small, pose, floor, at({0, 0, 0}), Vector3d::UnitZ());
    Pose lifted = pose;
    lifted.position.z() += 1e-3 - low;
    const auto touches = touches_of(small, lifted, floor, at({0, 0, 0}), 1e-2);
    ASSERT_FALSE(touches.empty());
    EXPECT_NEAR(nearest(touches).gap, 1e-3, 1e-10);
    EXPECT_EQ(nearest(touches).normal, Vector3d::UnitZ());
  }
}

TEST(NarrowPhase, TwoMeshesAreRefused) {
  const Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}};
  EXPECT_THROW(touches_of(mesh, {}, mesh, {}, 1.0), problems::InputError);
}

}  // namespace
}  // namespace conebench::dem::test
