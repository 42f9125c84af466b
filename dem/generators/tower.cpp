#include "dem/generators/tower.h"

#include <fmt/format.h>

#include "dem/generators/extent.h"
#include "problems/engine/scene_file.h"

namespace conebench::dem {

Tower read_tower(engine::TomlReader in) {
  Tower tower;
  tower.base_m = in.vector("base_m", tower.base_m);
  tower.size_m = read_size(in, "size_m");
  tower.levels = in.integer("levels", 1);
  tower.planks = in.integer("planks", 1);
  const double width = static_cast<double>(tower.planks) * tower.size_m.y();
  // Planks side by side may fill a level, whatever their sum rounds to.
  if (width > tower.size_m.x() * (1.0 + 1e-9)) {
    in.fail("planks", fmt::format("{} side by side are {} m wide, expected at most the length of "
                                  "one, {}",
                                  tower.planks, width, tower.size_m.x()));
  }
  tower.material = in.text("material");
  in.finish();
  return tower;
}

std::string show(const Tower& tower) {
  return fmt::format(
      "\n[[towers]]\nbase_m = {}\nsize_m = {}\nlevels = {}\nplanks = {}\nmaterial = {}\n",
      engine::show(tower.base_m), engine::show(tower.size_m), tower.levels, tower.planks,
      engine::quote(tower.material));
}

void place(const Tower& tower, Nursery& nursery) {
  const Eigen::Vector3d half = 0.5 * tower.size_m;
  const int along[] = {nursery.shape(Shape{"plank", {{Box{half}, {}}}}),
                       nursery.shape(Shape{"plank", {{Box{{half.y(), half.x(), half.z()}}, {}}}})};
  Seedling plank;
  plank.material = tower.material;
  for (std::int64_t level = 0; level < tower.levels; ++level) {
    const int axis = level % 2 == 0 ? 0 : 1;  // that planks lie along
    const std::int64_t count = nursery.dimension() == 2 && axis == 0 ? 1 : tower.planks;
    const double pitch =
        count == 1 ? 0.0 : (tower.size_m.x() - tower.size_m.y()) / static_cast<double>(count - 1);
    plank.solid = along[axis];
    for (std::int64_t i = 0; i < count; ++i) {
      plank.pose.position = tower.base_m;
      plank.pose.position[1 - axis] +=
          (static_cast<double>(i) - 0.5 * static_cast<double>(count - 1)) * pitch;
      plank.pose.position.z() += (static_cast<double>(level) + 0.5) * tower.size_m.z();
      nursery.add(plank);
    }
  }
}

}  // namespace conebench::dem
