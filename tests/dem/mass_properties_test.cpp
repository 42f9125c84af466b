#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "dem/shape.h"
#include "tests/dem/shape_helper.h"

namespace conebench::test {
namespace {

using dem::mass_properties;
using dem::MassProperties;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using std::numbers::pi;

// Relative to the size of what is expected; the sums round a few hundred times.
void expect_equal(const MassProperties& found, const MassProperties& expected,
                  double tolerance = 1e-13) {
  const double length = std::cbrt(std::abs(expected.volume_m3));
  EXPECT_NEAR(found.volume_m3, expected.volume_m3, tolerance * std::abs(expected.volume_m3));
  EXPECT_LT((found.centre_m - expected.centre_m).norm(),
            tolerance * (length + expected.centre_m.norm()));
  EXPECT_LT((found.inertia_m5 - expected.inertia_m5).norm(), tolerance * expected.inertia_m5.norm())
      << found.inertia_m5 << "\nexpected\n"
      << expected.inertia_m5;
}

MassProperties centred(double volume, const Vector3d& moments) {
  return {volume, Vector3d::Zero(), moments.asDiagonal()};
}

MassProperties displaced(const MassProperties& own, const dem::Pose& pose) {
  const Matrix3d turn = pose.orientation.toRotationMatrix();
  return {own.volume_m3, pose * own.centre_m, turn * own.inertia_m5 * turn.transpose()};
}

double simpson(const std::function<double(double)>& f, double low, double high) {
  constexpr int kPairs = 2000;
  const double h = (high - low) / (2 * kPairs);
  double sum = 0.0;
  for (int k = 0; k < kPairs; ++k) {
    const double x = low + 2 * k * h;
    sum += h / 3.0 * (f(x) + 4.0 * f(x + h) + f(x + 2.0 * h));
  }
  return sum;
}

TEST(MassProperties, OfABallABoxAndACylinderAreTheFormulae) {
  expect_equal(mass_properties(dem::Ball{2.0}),
               centred(32.0 / 3.0 * pi, Vector3d::Constant(0.4 * 4.0 * 32.0 / 3.0 * pi)));
  // Sides 2, 4, 6: V/12 (b^2 + c^2).
  expect_equal(mass_properties(dem::Box{{1.0, 2.0, 3.0}}),
               centred(48.0, {4.0 * (16 + 36), 4.0 * (4 + 36), 4.0 * (4 + 16)}));
  // V = pi r^2 L, V/12 (3 r^2 + L^2), V r^2 / 2.
  const double volume = pi * 4.0 * 6.0;
  expect_equal(mass_properties(dem::Cylinder{2.0, 3.0}),
               centred(volume, volume / 12.0 * Vector3d(12 + 36, 12 + 36, 24)));
}

// Discs of radius rho(z): pi rho^2, pi rho^4 / 4 + pi rho^2 z^2, pi rho^4 / 2.
TEST(MassProperties, OfACapsuleAreTheIntegralOverDiscs) {
  constexpr double r = 0.7, h = 1.1;
  const auto integral = [&](const std::function<double(double rho2, double z)>& of_disc) {
    const double ends =
        simpson([&](double z) { return of_disc(r * r - (z - h) * (z - h), z); }, h, h + r);
    return 2.0 * (ends + simpson([&](double z) { return of_disc(r * r, z); }, 0.0, h));
  };
  const double volume = integral([](double s, double) { return pi * s; });
  const double across = integral([](double s, double z) { return pi * s * (s / 4.0 + z * z); });
  const double along = integral([](double s, double) { return pi * s * s / 2.0; });
  expect_equal(mass_properties(dem::Capsule{r, h}), centred(volume, {across, across, along}));
}

// Of the corner (0,0,0), (1,0,0), (0,1,0), (0,0,1): integrals of x^2 are 1/60, of x y 1/120.
TEST(MassProperties, OfATetrahedronAreTheFormulae) {
  const dem::Hull corner{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  MassProperties expected{1.0 / 6.0, Vector3d::Constant(0.25), Matrix3d::Constant(1.0 / 480.0)};
  expected.inertia_m5.diagonal().setConstant(1.0 / 80.0);
  expect_equal(mass_properties(corner), expected);
}

TEST(MassProperties, OfAHullAndAMeshOfABoxAreThoseOfTheBoxWhereverItIs) {
  const Vector3d half(0.3, 0.5, 0.9);
  const MassProperties box = mass_properties(dem::Box{half});
  for (unsigned seed = 0; seed < 20; ++seed) {
    const dem::Pose pose = Draw(seed).pose();
    dem::Mesh mesh = box_mesh(half);
    mesh.vertices_m = moved(mesh.vertices_m, pose);
    SCOPED_TRACE(seed);
    expect_equal(mass_properties(dem::Hull{moved(grid(half, 3), pose)}), displaced(box, pose));
    expect_equal(mass_properties(mesh), displaced(box, pose));
  }
}

// A thousand sizes away the coordinates themselves are off by 1e-13 of the size.
TEST(MassProperties, OfAHullFarFromTheOriginLoseNoMoreThanItsCoordinates) {
  const Vector3d half(0.3, 0.5, 0.9);
  const dem::Pose far{{1000.0, -700.0, 500.0}, Eigen::Quaterniond::Identity()};
  const MassProperties found = mass_properties(dem::Hull{moved(grid(half, 2), far)});
  expect_equal(found, displaced(mass_properties(dem::Box{half}), far), 1e-11);
}

TEST(MassProperties, OfAMeshInsideOutAreNegative) {
  dem::Mesh mesh = box_mesh({0.3, 0.5, 0.9});
  for (Eigen::Vector3i& triangle : mesh.triangles) std::swap(triangle(0), triangle(1));
  const MassProperties box = mass_properties(dem::Box{{0.3, 0.5, 0.9}});
  expect_equal(mass_properties(mesh), {-box.volume_m3, Vector3d::Zero(), -box.inertia_m5});
}

TEST(MassProperties, OfARandomHullTurnWithIt) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    Draw draw(seed);
    dem::Hull hull;
    for (int k = 0; k < 40; ++k) hull.points_m.push_back(draw.normal());
    const MassProperties own = mass_properties(hull);
    const dem::Pose pose = draw.pose();
    hull.points_m = moved(hull.points_m, pose);
    SCOPED_TRACE(seed);
    expect_equal(mass_properties(hull), displaced(own, pose));
  }
}

// Points drawn in the box about a hull; inside are those behind all triangles. With N points, the
// standard deviation of a share p is sqrt(p (1 - p) / N); five of them pass by chance once in 2e6.
TEST(MassProperties, OfARandomHullHaveTheVolumeOfDrawnPoints) {
  constexpr int kPoints = 20000;
  for (unsigned seed = 0; seed < 5; ++seed) {
    Draw draw(seed);
    dem::Hull hull;
    for (int k = 0; k < 20; ++k) hull.points_m.push_back(draw.normal());
    const auto triangles = dem::hull_triangles(hull.points_m);
    const auto inside = [&](const Vector3d& x) {
      for (const Eigen::Vector3i& t : triangles) {
        Matrix3d edges;
        for (int k = 0; k < 3; ++k)
          edges.col(k) = hull.points_m[static_cast<std::size_t>(t(k))] - x;
        if (edges.determinant() < 0.0) return false;
      }
      return true;
    };
    const dem::Bounds bounds = dem::bounds_of(hull, {});
    const Vector3d middle = (bounds.low + bounds.high) / 2.0, half = bounds.high - middle;
    int hits = 0;
    for (int k = 0; k < kPoints; ++k) {
      const Vector3d share(draw.uniform(), draw.uniform(), draw.uniform());
      hits += inside(middle + half.cwiseProduct(share)) ? 1 : 0;
    }
    const double p = mass_properties(hull).volume_m3 / (8.0 * half.prod());
    EXPECT_NEAR(static_cast<double>(hits) / kPoints, p, 5.0 * std::sqrt(p * (1 - p) / kPoints));
  }
}

TEST(MassProperties, OfPartsOfABoxAreThoseOfTheBox) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const dem::Pose pose = Draw(seed).pose();
    // 2 x 4 x 6, cut at x = 0.5; the smaller part, 0.5 x 4 x 6, stands on another of its sides.
    const Eigen::Quaterniond quarter(Eigen::AngleAxisd(pi / 2.0, Vector3d::UnitZ()));
    const dem::Shape shape{
        "cut",
        {{dem::Box{{0.75, 2.0, 3.0}}, pose * dem::Pose{{-0.25, 0.0, 0.0}}},
         {dem::Box{{2.0, 0.25, 3.0}}, pose * dem::Pose{{0.75, 0.0, 0.0}, quarter}}}};
    SCOPED_TRACE(seed);
    expect_equal(mass_properties(shape),
                 displaced(mass_properties(dem::Box{{1.0, 2.0, 3.0}}), pose));
  }
}

// Two balls of 1 m3 at distance 2 d: 2 V d^2 more across.
TEST(MassProperties, OfTwoBallsFollowTheParallelAxisTheorem) {
  const dem::Ball ball{std::cbrt(0.75 / pi)};
  const double own = 0.4 * ball.radius_m * ball.radius_m;
  const dem::Shape pair{"pair", {{ball, {{3.0, 0.0, 1.5}}}, {ball, {{3.0, 0.0, -0.5}}}}};
  const Vector3d moments(2 * own + 2.0, 2 * own + 2.0, 2 * own);
  expect_equal(mass_properties(pair), {2.0, {3.0, 0.0, 0.5}, moments.asDiagonal()});
}

TEST(MassProperties, AreZeroWithoutVolume) {
  for (const MassProperties& none : {mass_properties(dem::Hull{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}),
                                     mass_properties(dem::Mesh{}), mass_properties(dem::Shape{})}) {
    EXPECT_EQ(none.volume_m3, 0.0);
    EXPECT_EQ(none.centre_m, Vector3d::Zero());
    EXPECT_EQ(none.inertia_m5, Matrix3d::Zero());
  }
}

}  // namespace
}  // namespace conebench::test
