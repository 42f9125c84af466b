#include "dem/generators/wall.h"

#include <fmt/format.h>

#include "dem/generators/extent.h"
#include "problems/engine/scene_file.h"

namespace conebench::dem {

using engine::Range;

Wall read_wall(engine::TomlReader in) {
  Wall wall;
  wall.base_m = in.vector("base_m", wall.base_m);
  wall.size_m = read_size(in, "size_m");
  wall.courses = in.integer("courses", 1);
  wall.bricks = in.integer("bricks", 1);
  wall.gap_m = in.number("gap_m", Range::kNotNegative, wall.gap_m);
  if (wall.gap_m >= wall.size_m.x()) {
    in.fail("gap_m", fmt::format("found {}, expected less than the length of a brick, {}",
                                 wall.gap_m, wall.size_m.x()));
  }
  wall.material = in.text("material");
  in.finish();
  return wall;
}

std::string show(const Wall& wall) {
  return fmt::format(
      "\n[[walls]]\nbase_m = {}\nsize_m = {}\ncourses = {}\nbricks = {}\ngap_m = {}\n"
      "material = {}\n",
      engine::show(wall.base_m), engine::show(wall.size_m), wall.courses, wall.bricks, wall.gap_m,
      engine::quote(wall.material));
}

void place(const Wall& wall, Nursery& nursery) {
  const double length = wall.size_m.x(), pitch = length + wall.gap_m;
  const double short_length = 0.5 * (length - wall.gap_m);
  const auto brick = [&](double along) {
    return Shape{"brick",
                 {{Box{0.5 * Eigen::Vector3d(along, wall.size_m.y(), wall.size_m.z())}, {}}}};
  };
  const int whole = nursery.shape(brick(length));
  const int half = wall.courses > 1 ? nursery.shape(brick(short_length)) : whole;
  Seedling seedling;
  seedling.material = wall.material;
  const auto add = [&](int solid, double x) {
    seedling.solid = solid;
    seedling.pose.position.x() = wall.base_m.x() + x;
    nursery.add(seedling);
  };
  for (std::int64_t course = 0; course < wall.courses; ++course) {
    seedling.pose.position = wall.base_m;
    seedling.pose.position.z() += (static_cast<double>(course) + 0.5) * wall.size_m.z();
    const bool bonded = course % 2 == 1;
    const std::int64_t wholes = bonded ? wall.bricks - 1 : wall.bricks;
    const double end = 0.5 * (static_cast<double>(wall.bricks) * pitch - wall.gap_m - short_length);
    if (bonded) add(half, -end);
    for (std::int64_t i = 0; i < wholes; ++i) {
      add(whole, (static_cast<double>(i) - 0.5 * static_cast<double>(wholes - 1)) * pitch);
    }
    if (bonded) add(half, end);
  }
}

}  // namespace conebench::dem
