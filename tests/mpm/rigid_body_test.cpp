#include "mpm/rigid_body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

namespace conebench::test {
namespace {

using Eigen::Vector3d;
using mpm::Body;
using mpm::Motion;
using mpm::RigidBody;
using mpm::Shape;

Body ball() { return {.shape = Shape::kBall, .centre_m = {0.3, -0.2, 0.0}, .radius_m = 0.7}; }

Body box(int dim) {
  Body body{.shape = Shape::kBox, .centre_m = {0.3, -0.2, 0.0}, .half_size_m = {0.7, 0.4, 0.0}};
  body.rotation_rad = dim == 2 ? Vector3d(0.0, 0.0, 0.6) : Vector3d(0.3, -0.5, 0.6);
  if (dim == 3) body.half_size_m.z() = 0.5;
  return body;
}

Body half_space(int dim) {
  Body body{.shape = Shape::kHalfSpace, .centre_m = {0.3, -0.2, 0.0}, .normal = {0.6, 0.8, 0.0}};
  body.rotation_rad = dim == 2 ? Vector3d(0.0, 0.0, 0.6) : Vector3d(0.3, -0.5, 0.6);
  return body;
}

// Midpoint of cell i of n equal ones on [-1, 1].
double midpoint(int i, int n) { return (2.0 * i + 1.0) / n - 1.0; }

// Points of the surface, n an axis on each face of the box, or of the cube around the ball.
std::vector<Vector3d> sample_surface(const RigidBody& body, int dim, int n) {
  std::vector<Vector3d> points;
  const int layers = dim == 2 ? 1 : n;
  for (int face = 0; face < 2 * dim; ++face) {
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < layers; ++j) {
        Vector3d x = Vector3d::Zero();
        x[face / 2] = face % 2 == 0 ? -1.0 : 1.0;
        x[(face / 2 + 1) % dim] = midpoint(i, n);
        if (dim == 3) x[(face / 2 + 2) % dim] = midpoint(j, n);
        const Vector3d local = body.body.shape == Shape::kBall
                                   ? Vector3d(body.body.radius_m * x.normalized())
                                   : Vector3d(x.cwiseProduct(body.body.half_size_m));
        points.emplace_back(body.centre_m + body.orientation * local);
      }
    }
  }
  return points;
}

double nearest(const std::vector<Vector3d>& points, const Vector3d& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vector3d& point : points) least = std::min(least, (point - x).norm());
  return least;
}

std::vector<Vector3d> some_places(int dim, int count) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  std::vector<Vector3d> places;
  for (int i = 0; i < count; ++i) {
    const double x = place(random), y = place(random), z = place(random);
    places.emplace_back(x, y, dim == 2 ? 0.0 : z);
  }
  return places;
}

TEST(RigidBody, DistanceIsThatToTheNearestPointOfTheSurface) {
  for (const int dim : {2, 3}) {
    const int n = dim == 2 ? 2000 : 100;
    for (const Body& described : {ball(), box(dim)}) {
      const RigidBody body = mpm::make_body(described, dim);
      const auto surface = sample_surface(body, dim, n);
      // Samples are at most 2 x 0.7 / n apart on each axis, so the nearest one is off the surface's
      // nearest point by less than this, and no nearer than it.
      const double apart = 1.4 / n;
      for (const Vector3d& x : some_places(dim, 100)) {
        const double found = std::abs(mpm::distance_to(body, dim, x).value);
        EXPECT_LE(found, nearest(surface, x) + 1e-12);
        EXPECT_GE(found, nearest(surface, x) - apart);
      }
    }
  }
}

TEST(RigidBody, DistanceIsNegativeInside) {
  for (const int dim : {2, 3}) {
    for (const Body& described : {ball(), box(dim)}) {
      const RigidBody body = mpm::make_body(described, dim);
      const double depth =
          described.shape == Shape::kBall ? 0.7 : described.half_size_m.head(dim).minCoeff();
      const mpm::Distance at_centre = mpm::distance_to(body, dim, body.centre_m);
      EXPECT_NEAR(at_centre.value, -depth, 1e-15);
      EXPECT_NEAR(at_centre.normal.norm(), 1.0, 1e-15);
    }
  }
}

TEST(RigidBody, NormalIsTheGradientOfTheDistance) {
  constexpr double kStep = 1e-6;  // second differences of the distance are below 1 / 0.01 m
  for (const int dim : {2, 3}) {
    for (const Body& described : {ball(), box(dim), half_space(dim)}) {
      const RigidBody body = mpm::make_body(described, dim);
      for (const Vector3d& x : some_places(dim, 50)) {
        const Vector3d normal = mpm::distance_to(body, dim, x).normal;
        EXPECT_NEAR(normal.norm(), 1.0, 1e-14);
        for (int a = 0; a < dim; ++a) {
          const Vector3d e = kStep * Vector3d::Unit(a);
          const double slope = (mpm::distance_to(body, dim, x + e).value -
                                mpm::distance_to(body, dim, x - e).value) /
                               (2.0 * kStep);
          EXPECT_NEAR(slope, normal[a], 1e-4);
        }
      }
    }
  }
}

TEST(RigidBody, HalfSpaceIsBelowItsPlane) {
  const Body floor{.shape = Shape::kHalfSpace, .centre_m = {0.0, 0.1, 0.0}, .normal = {0, 1, 0}};
  const RigidBody body = mpm::make_body(floor, 2);
  EXPECT_NEAR(mpm::distance_to(body, 2, {5.0, 0.4, 0.0}).value, 0.3, 1e-15);
  EXPECT_NEAR(mpm::distance_to(body, 2, {5.0, -0.4, 0.0}).value, -0.5, 1e-15);
  EXPECT_TRUE(mpm::surface_points(body, 2, Vector3d::UnitY()).empty());
  EXPECT_EQ(body.mass, 0.0);
}

TEST(RigidBody, TwoDimensionsIgnoreZ) {
  for (const Body& described : {ball(), box(2), half_space(2)}) {
    const RigidBody body = mpm::make_body(described, 2);
    for (const Vector3d& x : some_places(2, 20)) {
      const Vector3d above = x + 3.0 * Vector3d::UnitZ();
      EXPECT_EQ(mpm::distance_to(body, 2, above).value, mpm::distance_to(body, 2, x).value);
    }
  }
}

struct Moments {
  double mass = 0.0;
  Vector3d inertia = Vector3d::Zero();  // about the body's own axes
};

// By the midpoint rule on n cells an axis over the box around the body, `density` inside it.
Moments integrate(const RigidBody& body, int dim, int n, double density) {
  const Vector3d half = body.body.shape == Shape::kBall ? Vector3d::Constant(body.body.radius_m)
                                                        : body.body.half_size_m;
  double cell_mass = density;
  for (int a = 0; a < dim; ++a) cell_mass *= 2.0 / n * half[a];
  Moments sum;
  for (int k = 0; k < static_cast<int>(std::pow(n, dim)); ++k) {
    const int z = k / (n * n);
    Vector3d x(midpoint(k % n, n), midpoint(k / n % n, n), dim == 2 ? 0.0 : midpoint(z, n));
    x = x.cwiseProduct(half);
    const Vector3d place = body.centre_m + body.orientation * x;
    if (mpm::distance_to(body, dim, place).value > 0.0) continue;
    sum.mass += cell_mass;
    sum.inertia += cell_mass * (Vector3d::Constant(x.squaredNorm()) - x.cwiseAbs2());
  }
  return sum;
}

TEST(RigidBody, MassAndInertiaAreIntegralsOverTheBody) {
  constexpr double kDensity = 1200.0;
  for (const int dim : {2, 3}) {
    for (Body described : {ball(), box(dim)}) {
      described.motion = Motion::kFree;
      described.density_kg_m3 = kDensity;
      const RigidBody body = mpm::make_body(described, dim);
      const Moments expected = integrate(body, dim, 60, kDensity);
      // Box: the midpoint rule errs by 1/n^2 = 3e-4 of each moment. Ball: by its ragged edge, less
      // than 0.5 %.
      EXPECT_NEAR(body.mass, expected.mass, 5e-3 * body.mass);
      EXPECT_NEAR(body.inertia.z(), expected.inertia.z(), 5e-3 * body.inertia.z());
      if (dim == 2) continue;
      EXPECT_NEAR(body.inertia.x(), expected.inertia.x(), 5e-3 * body.inertia.x());
      EXPECT_NEAR(body.inertia.y(), expected.inertia.y(), 5e-3 * body.inertia.y());
    }
  }
}

TEST(RigidBody, SurfacePointsHoldTheLowestOne) {
  for (const int dim : {2, 3}) {
    for (const Body& described : {ball(), box(dim)}) {
      const RigidBody body = mpm::make_body(described, dim);
      const Vector3d normal = Vector3d::UnitY();
      const auto points = mpm::surface_points(body, dim, normal);
      EXPECT_EQ(points.size(), described.shape == Shape::kBall ? 1u : (dim == 2 ? 4u : 8u));
      double lowest = std::numeric_limits<double>::infinity();
      for (const Vector3d& point : points) {
        EXPECT_NEAR(mpm::distance_to(body, dim, point).value, 0.0, 1e-14);
        lowest = std::min(lowest, point.y());
      }
      for (const Vector3d& point : sample_surface(body, dim, 40)) {
        EXPECT_GE(point.y(), lowest - 1e-14);
      }
    }
  }
}

TEST(RigidBody, ASteadyTurnIsExactWhateverTheStep) {
  RigidBody body = mpm::make_body(box(3), 3);
  const RigidBody start = body;
  body.velocity = {1.0, 2.0, -3.0};
  body.angular_velocity = {0.4, 1.1, -0.7};
  const double turn_s = 2.0 * std::numbers::pi / body.angular_velocity.norm();
  for (int k = 0; k < 7; ++k) mpm::advance(body, turn_s / 7.0);
  EXPECT_NEAR((body.centre_m - start.centre_m - turn_s * body.velocity).norm(), 0.0, 1e-13);
  EXPECT_NEAR(body.orientation.angularDistance(start.orientation), 0.0, 1e-7);
  EXPECT_NEAR(body.orientation.norm(), 1.0, 1e-15);
}

TEST(RigidBody, PointsMoveWithTheVelocityOfTheBodyThere) {
  constexpr double kStep = 1e-6;  // their paths bend by 0.5 h omega^2 r < 2e-6 m/s
  RigidBody body = mpm::make_body(box(3), 3);
  body.velocity = {1.0, 2.0, -3.0};
  body.angular_velocity = {0.4, 1.1, -0.7};
  const auto before = mpm::surface_points(body, 3, Vector3d::UnitZ());
  RigidBody moved = body;
  mpm::advance(moved, kStep);
  const auto after = mpm::surface_points(moved, 3, Vector3d::UnitZ());
  for (std::size_t i = 0; i < before.size(); ++i) {
    const Vector3d velocity = (after[i] - before[i]) / kStep;
    EXPECT_NEAR((velocity - body.velocity_at(before[i])).norm(), 0.0, 2e-6);
  }
}

}  // namespace
}  // namespace conebench::test
