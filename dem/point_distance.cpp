#include "dem/point_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace conebench::dem {
namespace {

using Eigen::Vector3d;

// Of the extent: nearer than this, the way from the nearest point has no direction.
constexpr double kTouching = 1e-12;

const Vector3d& at(const Convex& convex, int k) {
  return convex.points[static_cast<std::size_t>(k)];
}

Vector3d nearest_in_side(const Vector3d& point, const Vector3d& a, const Vector3d& b) {
  const Vector3d along = b - a;
  const double share = along.dot(point - a) / along.squaredNorm();
  if (share <= 0.0) return a;
  if (share >= 1.0) return b;
  return a + along * share;
}

// From the nearest point of the core, `else_normal` where that is the point itself.
PointDistance from_core(const Convex& convex, const Vector3d& point, const Vector3d& nearest,
                        const Vector3d& else_normal) {
  const double distance = (point - nearest).norm();
  if (distance <= kTouching * convex.extent) return {-convex.radius, else_normal};
  return {distance - convex.radius, (point - nearest) / distance};
}

PointDistance to_cylinder(const Convex& cylinder, const Vector3d& point) {
  const double half_length = at(cylinder, 1).z();
  const Vector3d radial(point.x(), point.y(), 0.0);
  const double from_axis = radial.norm();
  const Vector3d outwards = from_axis > 0.0 ? Vector3d(radial / from_axis) : Vector3d::UnitX();
  const Vector3d up = point.z() < 0.0 ? Vector3d(-Vector3d::UnitZ()) : Vector3d(Vector3d::UnitZ());
  const double side = from_axis - cylinder.disc, end = std::abs(point.z()) - half_length;
  if (side <= 0.0 || end <= 0.0) {
    return end > side ? PointDistance{end, up} : PointDistance{side, outwards};
  }
  const double distance = std::hypot(side, end);
  return {distance, (side * outwards + end * up) / distance};
}

// Whether the point is right above a face; otherwise `nearest` is made nearer by its sides.
bool above_face(const Convex& convex, const Convex::Face& face, const Vector3d& point,
                Vector3d& nearest) {
  bool above = true;
  for (std::size_t k = 0; k < face.corners.size(); ++k) {
    const Vector3d& a = at(convex, face.corners[k]);
    const Vector3d& b = at(convex, face.corners[(k + 1) % face.corners.size()]);
    if (face.normal.cross(b - a).dot(point - a) >= 0.0) continue;
    above = false;
    const Vector3d here = nearest_in_side(point, a, b);
    if ((here - point).squaredNorm() < (nearest - point).squaredNorm()) nearest = here;
  }
  return above;
}

PointDistance to_polyhedron(const Convex& convex, const Vector3d& point) {
  PointDistance inside{-std::numeric_limits<double>::infinity(), Vector3d::UnitZ()};
  Vector3d nearest = Vector3d::Constant(std::numeric_limits<double>::infinity());
  for (const Convex::Face& face : convex.faces) {
    const double height = face.normal.dot(point - at(convex, face.corners[0]));
    if (height > inside.distance) inside = {height, face.normal};
    if (height > 0.0 && above_face(convex, face, point, nearest)) return {height, face.normal};
  }
  if (inside.distance <= 0.0) return inside;
  return from_core(convex, point, nearest, inside.normal);
}

}  // namespace

PointDistance point_distance(const Convex& convex, const Vector3d& point) {
  if (convex.disc > 0.0) return to_cylinder(convex, point);
  if (!convex.faces.empty()) return to_polyhedron(convex, point);
  if (convex.edges.empty()) return from_core(convex, point, at(convex, 0), Vector3d::UnitZ());
  return from_core(convex, point, nearest_in_side(point, at(convex, 0), at(convex, 1)),
                   Vector3d::UnitX());
}

TrianglePoint nearest_in_triangle(const Vector3d& point, const Vector3d& a, const Vector3d& b,
                                  const Vector3d& c) {
  const std::array<const Vector3d*, 3> corner = {&a, &b, &c};
  const Vector3d normal = (b - a).cross(c - a);
  TrianglePoint best{point - normal * (normal.dot(point - a) / normal.squaredNorm()), 7};
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k) {
    const Vector3d &from = *corner[k], &to = *corner[(k + 1) % 3];
    if (normal.cross(to - from).dot(point - from) >= 0.0) continue;
    const Vector3d here = nearest_in_side(point, from, to);
    const double square = (here - point).squaredNorm();
    if (square >= least) continue;
    least = square;
    best.nearest = here;
    best.corners = here == from ? 1 << k
                   : here == to ? 1 << (k + 1) % 3
                                : 1 << k | 1 << (k + 1) % 3;
  }
  return best;
}

}  // namespace conebench::dem
