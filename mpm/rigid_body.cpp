#include "mpm/rigid_body.h"

#include <numbers>

namespace conebench::mpm {
namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;

Quaterniond rotation_by(const Vector3d& rotation_rad) {
  const double angle = rotation_rad.norm();
  if (angle == 0.0) return Quaterniond::Identity();
  return Quaterniond(Eigen::AngleAxisd(angle, rotation_rad / angle));
}

Distance distance_to_ball(double radius, const Vector3d& offset) {
  const double length = offset.norm();
  return {length - radius, length > 0.0 ? Vector3d(offset / length) : Vector3d::UnitX()};
}

// In the box's own frame.
Distance distance_to_box(const Vector3d& half_size, int dim, const Vector3d& offset) {
  Vector3d beyond = Vector3d::Zero();  // from the nearest point of the box to `offset`
  int nearest = 0;                     // axis of the nearest face
  const Vector3d excess = offset.cwiseAbs() - half_size;
  for (int a = 0; a < dim; ++a) {
    if (excess[a] > 0.0) beyond[a] = std::copysign(excess[a], offset[a]);
    if (excess[a] > excess[nearest]) nearest = a;
  }
  const double length = beyond.norm();
  if (length > 0.0) return {length, beyond / length};
  return {excess[nearest], Vector3d::Unit(nearest) * std::copysign(1.0, offset[nearest])};
}

// Volume in 3D, area in 2D.
double size_of(const Body& body, int dim) {
  constexpr double kPi = std::numbers::pi;
  const double R = body.radius_m;
  if (body.shape == Shape::kBall) return dim == 2 ? kPi * R * R : 4.0 / 3.0 * kPi * R * R * R;
  return (2.0 * body.half_size_m.head(dim)).prod();
}

// Principal moments of a body of unit mass; in two dimensions about z only.
Vector3d unit_inertia(const Body& body, int dim) {
  const double R2 = body.radius_m * body.radius_m;
  const Vector3d squared = body.half_size_m.cwiseAbs2() / 3.0;
  if (dim == 2) {
    const double about_z = body.shape == Shape::kBall ? 0.5 * R2 : squared[0] + squared[1];
    return {0.0, 0.0, about_z};
  }
  if (body.shape == Shape::kBall) return Vector3d::Constant(0.4 * R2);
  return Vector3d::Constant(squared.sum()) - squared;
}

}  // namespace

Distance distance_to(const RigidBody& body, int dim, const Vector3d& x) {
  Vector3d offset = x - body.centre_m;
  if (dim == 2) offset.z() = 0.0;
  switch (body.body.shape) {
    case Shape::kBall:
      return distance_to_ball(body.body.radius_m, offset);
    case Shape::kBox: {
      const Distance local =
          distance_to_box(body.body.half_size_m, dim, body.orientation.conjugate() * offset);
      return {local.value, body.orientation * local.normal};
    }
    case Shape::kHalfSpace: {
      const Vector3d normal = body.orientation * body.body.normal;
      return {normal.dot(offset), normal};
    }
  }
  return {};
}

RigidBody make_body(const Body& body, int dim) {
  RigidBody made;
  made.body = body;
  made.centre_m = body.centre_m;
  made.orientation = rotation_by(body.rotation_rad);
  made.velocity = body.velocity_m_s;
  made.angular_velocity = body.angular_velocity_rad_s;
  if (made.moves_freely()) {
    made.mass = body.density_kg_m3 * size_of(body, dim);
    made.inertia = made.mass * unit_inertia(body, dim);
  }
  return made;
}

std::vector<Vector3d> surface_points(const RigidBody& body, int dim, const Vector3d& normal) {
  if (body.body.shape == Shape::kHalfSpace) return {};
  if (body.body.shape == Shape::kBall) return {body.centre_m - body.body.radius_m * normal};
  std::vector<Vector3d> corners;
  for (int k = 0; k < (1 << dim); ++k) {
    Vector3d corner = Vector3d::Zero();
    for (int a = 0; a < dim; ++a) {
      corner[a] = ((k >> a) & 1) != 0 ? body.body.half_size_m[a] : -body.body.half_size_m[a];
    }
    corners.emplace_back(body.centre_m + body.orientation * corner);
  }
  return corners;
}

void advance(RigidBody& body, double h) {
  body.centre_m += h * body.velocity;
  const Quaterniond turned = rotation_by(h * body.angular_velocity) * body.orientation;
  body.orientation = turned.normalized();
}

}  // namespace conebench::mpm
