#include "narrow_phase_oracle.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace conebench::dem::test {
namespace {

using Eigen::Vector3d;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

std::vector<Vector3d> corners_of(const Piece& piece) {
  if (const auto* hull = std::get_if<Hull>(&piece)) return hull->points_m;
  std::vector<Vector3d> corners;
  const Vector3d& half = std::get<Box>(piece).half_m;
  for (const double x : {-half.x(), half.x()}) {
    for (const double y : {-half.y(), half.y()}) {
      for (const double z : {-half.z(), half.z()}) corners.push_back({x, y, z});
    }
  }
  return corners;
}

struct LocalSupport {
  Vector3d d;  // unit length

  Vector3d operator()(const Ball& ball) const { return ball.radius_m * d; }
  Vector3d operator()(const Capsule& c) const {
    return c.radius_m * d + std::copysign(c.half_length_m, d.z()) * Vector3d::UnitZ();
  }
  Vector3d operator()(const Cylinder& c) const {
    const double radial = std::hypot(d.x(), d.y());
    const double scale = radial > 0.0 ? c.radius_m / radial : 0.0;
    return {scale * d.x(), scale * d.y(), std::copysign(c.half_length_m, d.z())};
  }
  Vector3d operator()(const Mesh&) const { return Vector3d::Zero(); }
  template <class Polyhedron>
  Vector3d operator()(const Polyhedron& polyhedron) const {
    const auto corners = corners_of(Piece(polyhedron));
    return *std::max_element(corners.begin(), corners.end(),
                             [&](const auto& a, const auto& b) { return a.dot(d) < b.dot(d); });
  }
};

double point_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

double point_triangle(const Vector3d& p, const std::array<Vector3d, 3>& t) {
  Eigen::Matrix<double, 3, 2> sides;
  sides << t[1] - t[0], t[2] - t[0];
  const Eigen::Vector2d share =
      (sides.transpose() * sides).inverse() * (sides.transpose() * (p - t[0]));
  if (share.minCoeff() >= 0.0 && share.sum() <= 1.0) return (p - t[0] - sides * share).norm();
  return std::min(
      {point_segment(p, t[0], t[1]), point_segment(p, t[1], t[2]), point_segment(p, t[2], t[0])});
}

double separation_along(const Triangles& first, const Triangles& second, const Vector3d& normal) {
  double low = kInfinity, high = -kInfinity;
  for (const auto& t : first) {
    for (const Vector3d& x : t) low = std::min(low, normal.dot(x));
  }
  for (const auto& t : second) {
    for (const Vector3d& x : t) high = std::max(high, normal.dot(x));
  }
  return low - high;
}

Vector3d normal_of(const std::array<Vector3d, 3>& t) {
  return (t[1] - t[0]).cross(t[2] - t[0]).normalized();
}

}  // namespace

Vector3d support(const Piece& piece, const Pose& pose, const Vector3d& direction) {
  const Vector3d local = (pose.orientation.conjugate() * direction).normalized();
  return pose * std::visit(LocalSupport{local}, piece);
}

double separation(const Piece& first, const Pose& first_pose, const Piece& second,
                  const Pose& second_pose, const Vector3d& normal) {
  return normal.dot(support(first, first_pose, -normal) - support(second, second_pose, normal));
}

bool holds(const Piece& piece, const Pose& pose, const Vector3d& point, double tolerance) {
  const Vector3d x = pose.orientation.conjugate() * (point - pose.position);
  if (const auto* ball = std::get_if<Ball>(&piece)) return x.norm() <= ball->radius_m + tolerance;
  if (const auto* c = std::get_if<Capsule>(&piece)) {
    const Vector3d end(0.0, 0.0, c->half_length_m);
    return point_segment(x, -end, end) <= c->radius_m + tolerance;
  }
  if (const auto* c = std::get_if<Cylinder>(&piece)) {
    return std::hypot(x.x(), x.y()) <= c->radius_m + tolerance &&
           std::abs(x.z()) <= c->half_length_m + tolerance;
  }
  const Triangles triangles = triangles_of(piece, Pose{});
  return std::all_of(triangles.begin(), triangles.end(),
                     [&](const auto& t) { return normal_of(t).dot(x - t[0]) <= tolerance; });
}

Triangles triangles_of(const Piece& piece, const Pose& pose) {
  const auto corners = corners_of(piece);
  Triangles triangles;
  for (const auto& t : hull_triangles(corners)) {
    const auto corner = [&](int k) { return pose * corners[static_cast<std::size_t>(t(k))]; };
    triangles.push_back({corner(0), corner(1), corner(2)});
  }
  return triangles;
}

double segment_distance(const Vector3d& a, const Vector3d& b, const Vector3d& c,
                        const Vector3d& d) {
  double least = std::min({point_segment(a, c, d), point_segment(b, c, d), point_segment(c, a, b),
                           point_segment(d, a, b)});
  Eigen::Matrix<double, 3, 2> sides;
  sides << b - a, c - d;
  const Eigen::Matrix2d gram = sides.transpose() * sides;
  if (gram.determinant() > 1e-14 * gram(0, 0) * gram(1, 1)) {
    const Eigen::Vector2d share = gram.inverse() * (sides.transpose() * (c - a));
    if (share.minCoeff() >= 0.0 && share.maxCoeff() <= 1.0) {
      least = std::min(least, (c - a - sides * share).norm());
    }
  }
  return least;
}

double distance_of(const Triangles& first, const Triangles& second) {
  double least = kInfinity;
  for (const auto& a : first) {
    for (const auto& b : second) {
      for (std::size_t i = 0; i < 3; ++i) {
        least = std::min({least, point_triangle(a[i], b), point_triangle(b[i], a)});
        for (std::size_t j = 0; j < 3; ++j) {
          least = std::min(least, segment_distance(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
        }
      }
    }
  }
  return least;
}

double distance_of(const Vector3d& point, const Triangles& triangles) {
  double least = kInfinity;
  for (const auto& t : triangles) least = std::min(least, point_triangle(point, t));
  return least;
}

double greatest_separation(const Triangles& first, const Triangles& second) {
  double most = -kInfinity;
  for (const auto& a : first) most = std::max(most, separation_along(first, second, -normal_of(a)));
  for (const auto& b : second) most = std::max(most, separation_along(first, second, normal_of(b)));
  for (const auto& a : first) {
    for (const auto& b : second) {
      for (std::size_t i = 0; i < 9; ++i) {
        const Vector3d side_a = a[(i + 1) % 3] - a[i % 3], side_b = b[(i / 3 + 1) % 3] - b[i / 3];
        const Vector3d normal = side_a.cross(side_b);
        if (normal.norm() < 1e-9 * side_a.norm() * side_b.norm()) continue;
        most = std::max({most, separation_along(first, second, normal.normalized()),
                         separation_along(first, second, -normal.normalized())});
      }
    }
  }
  return most;
}

}  // namespace conebench::dem::test
