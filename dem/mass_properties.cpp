#include <Eigen/Geometry>
#include <numbers>
#include <span>

#include "dem/shape.h"

namespace conebench::dem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using std::numbers::pi;

MassProperties centred(double volume_m3, double inertia_x, double inertia_y, double inertia_z) {
  return {volume_m3, Vector3d::Zero(), Vector3d(inertia_x, inertia_y, inertia_z).asDiagonal()};
}

// Of a point of mass 1 at x, about the origin.
Matrix3d point_inertia(const Vector3d& x) {
  return x.squaredNorm() * Matrix3d::Identity() - x * x.transpose();
}

MassProperties properties_of(const Ball& ball) {
  const double r = ball.radius_m, volume = 4.0 / 3.0 * pi * r * r * r;
  const double inertia = 0.4 * volume * r * r;
  return centred(volume, inertia, inertia, inertia);
}

MassProperties properties_of(const Box& box) {
  const Vector3d square = box.half_m.cwiseAbs2();
  const double third = 8.0 * box.half_m.prod() / 3.0;
  return centred(8.0 * box.half_m.prod(), third * (square.y() + square.z()),
                 third * (square.z() + square.x()), third * (square.x() + square.y()));
}

MassProperties properties_of(const Cylinder& cylinder) {
  const double r = cylinder.radius_m, h = cylinder.half_length_m;
  const double volume = 2.0 * pi * r * r * h;
  const double across = volume * (r * r / 4.0 + h * h / 3.0);
  return centred(volume, across, across, volume * r * r / 2.0);
}

// A cylinder and two hemispheres. A hemisphere has 2/5 V r^2 about any axis through the middle of
// its flat face, and its centre lies 3/8 r from there: moved out by h that makes
// V (2/5 r^2 + h^2 + 3/4 h r).
MassProperties properties_of(const Capsule& capsule) {
  const double r = capsule.radius_m, h = capsule.half_length_m;
  MassProperties properties = properties_of(Cylinder{r, h});
  const double ends = 4.0 / 3.0 * pi * r * r * r;
  const double across = ends * (0.4 * r * r + h * h + 0.75 * h * r);
  properties.volume_m3 += ends;
  properties.inertia_m5.diagonal() += Vector3d(across, across, 0.4 * ends * r * r);
  return properties;
}

// Sums over the tetrahedra that join the triangles to one point. With s = a + b + c the integral
// of x x^T over the tetrahedron (0, a, b, c) of volume V is V/20 (a a^T + b b^T + c c^T + s s^T).
MassProperties enclosed(std::span<const Vector3d> vertices,
                        std::span<const Eigen::Vector3i> triangles) {
  MassProperties properties;
  if (triangles.empty()) return properties;
  const auto at = [&](int k) { return vertices[static_cast<std::size_t>(k)]; };
  const Vector3d origin = at(triangles.front()(0));

  double volume = 0.0;
  Vector3d first = Vector3d::Zero();
  Matrix3d second = Matrix3d::Zero();
  for (const Eigen::Vector3i& triangle : triangles) {
    Matrix3d corners;
    for (int k = 0; k < 3; ++k) corners.col(k) = at(triangle(k)) - origin;
    const double part = corners.determinant() / 6.0;
    const Vector3d sum = corners.rowwise().sum();
    volume += part;
    first += part / 4.0 * sum;
    second += part / 20.0 * (corners * corners.transpose() + sum * sum.transpose());
  }
  if (volume == 0.0) return properties;

  const Vector3d centre = first / volume;
  second -= volume * centre * centre.transpose();
  properties.volume_m3 = volume;
  properties.centre_m = origin + centre;
  properties.inertia_m5 = second.trace() * Matrix3d::Identity() - second;
  return properties;
}

MassProperties properties_of(const Hull& hull) {
  return enclosed(hull.points_m, hull_triangles(hull.points_m));
}

MassProperties properties_of(const Mesh& mesh) { return enclosed(mesh.vertices_m, mesh.triangles); }

MassProperties moved(const MassProperties& own, const Pose& pose) {
  const Matrix3d turn = pose.orientation.toRotationMatrix();
  return {own.volume_m3, pose * own.centre_m, turn * own.inertia_m5 * turn.transpose()};
}

}  // namespace

MassProperties mass_properties(const Piece& piece) {
  return std::visit([](const auto& kind) { return properties_of(kind); }, piece);
}

MassProperties mass_properties(const Shape& shape) {
  std::vector<MassProperties> parts;
  MassProperties whole;
  for (const auto& [piece, pose] : shape.parts) {
    parts.push_back(moved(mass_properties(piece), pose));
    whole.volume_m3 += parts.back().volume_m3;
  }
  if (whole.volume_m3 == 0.0) return whole;
  for (const MassProperties& part : parts) {
    whole.centre_m += part.volume_m3 / whole.volume_m3 * part.centre_m;
  }
  for (const MassProperties& part : parts) {
    whole.inertia_m5 +=
        part.inertia_m5 + part.volume_m3 * point_inertia(part.centre_m - whole.centre_m);
  }
  return whole;
}

}  // namespace conebench::dem
