#include "dem/generators/drum.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "problems/engine/scene_file.h"

namespace conebench::dem {

using engine::Range;
using std::numbers::pi;

namespace {

Eigen::Quaterniond turn(double angle_rad, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis));
}

// Boxes so wide that they meet on the outside: what overlaps lies behind the inner faces.
void add_ring(const Drum& drum, Shape& shape) {
  const double angle = 2.0 * pi / static_cast<double>(drum.staves);
  const double outside = drum.radius_m + drum.wall_m;
  const Box stave{{outside * std::tan(0.5 * angle), 0.5 * drum.length_m, 0.5 * drum.wall_m}};
  for (std::int64_t i = 0; i < drum.staves; ++i) {
    Pose pose;
    pose.orientation = turn(static_cast<double>(i) * angle, Eigen::Vector3d::UnitY());
    pose.position = pose.orientation * Eigen::Vector3d(0.0, 0.0, drum.radius_m + 0.5 * drum.wall_m);
    shape.parts.push_back({stave, pose});
  }
}

// As wide as the corners of the ring, so that nothing gets past.
void add_plates(const Drum& drum, Shape& shape) {
  const double radius = drum.radius_m / std::cos(pi / static_cast<double>(drum.staves));
  const Cylinder plate{radius, 0.5 * drum.wall_m};
  for (const double sign : {-1.0, 1.0}) {
    Pose pose;
    pose.orientation = turn(0.5 * pi, Eigen::Vector3d::UnitX());
    pose.position.y() = 0.5 * sign * (drum.length_m + drum.wall_m);
    shape.parts.push_back({plate, pose});
  }
}

}  // namespace

Drum read_drum(engine::TomlReader in) {
  Drum drum;
  drum.centre_m = in.vector("centre_m", drum.centre_m);
  drum.radius_m = in.number("radius_m", Range::kPositive);
  drum.length_m = in.number("length_m", Range::kPositive);
  drum.wall_m = in.number("wall_m", Range::kPositive);
  drum.staves = in.integer("staves", 3, drum.staves);
  drum.motion = in.text("motion", "");
  drum.material = in.text("material");
  in.finish();
  return drum;
}

std::string show(const Drum& drum) {
  return fmt::format(
             "\n[[drums]]\ncentre_m = {}\nradius_m = {}\nlength_m = {}\nwall_m = {}\nstaves = {}\n",
             engine::show(drum.centre_m), drum.radius_m, drum.length_m, drum.wall_m, drum.staves) +
         (drum.motion.empty() ? "" : fmt::format("motion = {}\n", engine::quote(drum.motion))) +
         fmt::format("material = {}\n", engine::quote(drum.material));
}

void place(const Drum& drum, Nursery& nursery) {
  Shape shape{"drum", {}};
  add_ring(drum, shape);
  if (nursery.dimension() == 3) add_plates(drum, shape);
  Seedling seedling;
  seedling.solid = nursery.shape(shape);
  seedling.pose.position = drum.centre_m;
  seedling.material = drum.material;
  seedling.motion = drum.motion;
  seedling.fixed = drum.motion.empty();
  nursery.add(seedling);
}

}  // namespace conebench::dem
