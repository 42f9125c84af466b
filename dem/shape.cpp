#include "dem/shape.h"

#include <algorithm>
#include <cmath>

namespace conebench::dem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Bounds about(const Vector3d& centre, const Vector3d& reach) {
  return {centre - reach, centre + reach};
}

void take_in(Bounds& bounds, const Vector3d& x) {
  bounds.low = bounds.low.cwiseMin(x);
  bounds.high = bounds.high.cwiseMax(x);
}

// How far a circle of radius 1 about the unit vector `axis` goes along each coordinate axis.
Vector3d circle_reach(const Vector3d& axis) {
  return {std::hypot(axis.y(), axis.z()), std::hypot(axis.z(), axis.x()),
          std::hypot(axis.x(), axis.y())};
}

Bounds bounds_of(const Ball& ball, const Pose& pose) {
  return about(pose.position, Vector3d::Constant(ball.radius_m));
}

Bounds bounds_of(const Box& box, const Pose& pose) {
  const Matrix3d turn = pose.orientation.toRotationMatrix();
  return about(pose.position, turn.cwiseAbs() * box.half_m);
}

Bounds bounds_of(const Capsule& capsule, const Pose& pose) {
  const Vector3d axis = pose.orientation * Vector3d::UnitZ();
  return about(pose.position, (capsule.half_length_m * axis.cwiseAbs()).array() + capsule.radius_m);
}

Bounds bounds_of(const Cylinder& cylinder, const Pose& pose) {
  const Vector3d axis = pose.orientation * Vector3d::UnitZ();
  return about(pose.position,
               cylinder.half_length_m * axis.cwiseAbs() + cylinder.radius_m * circle_reach(axis));
}

Bounds bounds_of(const Hull& hull, const Pose& pose) {
  Bounds bounds = about(pose * hull.points_m.front(), Vector3d::Zero());
  for (const Vector3d& point : hull.points_m) take_in(bounds, pose * point);
  return bounds;
}

// Of the triangles: vertices that none of them has do not count.
Bounds bounds_of(const Mesh& mesh, const Pose& pose) {
  const auto vertex = [&](int k) { return pose * mesh.vertices_m[static_cast<std::size_t>(k)]; };
  Bounds bounds = about(vertex(mesh.triangles.front()(0)), Vector3d::Zero());
  for (const Eigen::Vector3i& triangle : mesh.triangles) {
    for (const int k : triangle) take_in(bounds, vertex(k));
  }
  return bounds;
}

}  // namespace

bool Shape::has_mesh() const {
  return std::ranges::any_of(
      parts, [](const Part& part) { return std::holds_alternative<Mesh>(part.piece); });
}

Bounds bounds_of(const Piece& piece, const Pose& pose) {
  return std::visit([&](const auto& kind) { return bounds_of(kind, pose); }, piece);
}

}  // namespace conebench::dem
