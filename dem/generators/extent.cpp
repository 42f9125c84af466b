#include "dem/generators/extent.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace conebench::dem {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

// From a point in a piece's own frame to what of the piece is farthest from it.
struct FarthestFrom {
  Vector3d x;

  double operator()(const Ball& ball) const { return x.norm() + ball.radius_m; }
  double operator()(const Box& box) const { return (x.cwiseAbs() + box.half_m).norm(); }
  double operator()(const Capsule& c) const { return to_rim(0.0, c.half_length_m) + c.radius_m; }
  double operator()(const Cylinder& c) const { return to_rim(c.radius_m, c.half_length_m); }
  double operator()(const Hull& hull) const { return to_points(hull.points_m); }
  double operator()(const Mesh& mesh) const { return to_points(mesh.vertices_m); }

 private:
  double to_rim(double radius, double half_length) const {
    return std::hypot(x.head<2>().norm() + radius, std::abs(x.z()) + half_length);
  }
  double to_points(const std::vector<Vector3d>& points) const {
    double most = 0.0;
    for (const Vector3d& point : points) most = std::max(most, (point - x).norm());
    return most;
  }
};

}  // namespace

Extent extent_of(const Solid& solid) {
  const Pose to_shape = solid.from_shape.inverse();
  Eigen::AlignedBox3d box;
  for (const Part& part : solid.parts) {
    const Bounds bounds = bounds_of(part.piece, to_shape * part.pose);
    box.extend(bounds.low);
    box.extend(bounds.high);
  }
  Extent extent{box.center(), 0.5 * box.sizes(), 0.0};
  for (const Part& part : solid.parts) {
    const Vector3d centre = (to_shape * part.pose).inverse() * extent.centre_m;
    extent.radius_m = std::max(extent.radius_m, std::visit(FarthestFrom{centre}, part.piece));
  }
  return extent;
}

Eigen::Quaterniond random_turn(Nursery& nursery) {
  if (nursery.dimension() == 2) {
    const double angle = 2.0 * pi * nursery.random();
    return Eigen::Quaterniond(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
  }
  const double share = nursery.random();
  const double first = 2.0 * pi * nursery.random(), second = 2.0 * pi * nursery.random();
  const double a = std::sqrt(1.0 - share), b = std::sqrt(share);
  return Eigen::Quaterniond(b * std::cos(second), a * std::sin(first), a * std::cos(first),
                            b * std::sin(second));
}

Eigen::Vector3d read_size(engine::TomlReader& in, std::string_view key) {
  const std::vector<double> numbers = in.numbers(key, 3, engine::Range::kPositive);
  return {numbers[0], numbers[1], numbers[2]};
}

}  // namespace conebench::dem
