#include "dem/generators/hopper.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "problems/engine/scene_file.h"
#include "problems/error.h"

namespace conebench::dem {

using engine::Range;

namespace {

// How much farther out a wall's outer face is than its inner one, along the horizontal.
double wall_run(const Hopper& hopper) {
  return hopper.wall_m * std::hypot(1.0, 0.5 * (hopper.top_m - hopper.outlet_m) / hopper.height_m);
}

// A wall that faces -x. `half_width(x)`: half its width along y where it is x from the axis.
template <class HalfWidth>
Hull wall(const Hopper& hopper, const HalfWidth& half_width) {
  Hull hull;
  for (const auto& [inner, z] :
       {std::pair(0.5 * hopper.outlet_m, 0.0), std::pair(0.5 * hopper.top_m, hopper.height_m)}) {
    for (const double x : {inner, inner + wall_run(hopper)}) {
      hull.points_m.emplace_back(x, -half_width(x), z);
      hull.points_m.emplace_back(x, half_width(x), z);
    }
  }
  return hull;
}

Pose turned(double angle_rad) {
  return {Eigen::Vector3d::Zero(),
          Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()))};
}

Shape cone(const Hopper& hopper) {
  const double angle = 2.0 * std::numbers::pi / static_cast<double>(hopper.staves);
  const Hull stave = wall(hopper, [&](double x) { return x * std::tan(0.5 * angle); });
  Shape shape{"hopper", {}};
  for (std::int64_t i = 0; i < hopper.staves; ++i) {
    shape.parts.push_back({stave, turned(static_cast<double>(i) * angle)});
  }
  return shape;
}

Shape wedge(const Hopper& hopper, bool with_ends) {
  const Hull side = wall(hopper, [&](double) { return 0.5 * hopper.length_m; });
  Shape shape{"hopper", {{side, {}}, {side, turned(std::numbers::pi)}}};
  if (!with_ends) return shape;
  const Box end{
      {0.5 * hopper.top_m + wall_run(hopper), 0.5 * hopper.wall_m, 0.5 * hopper.height_m}};
  for (const double sign : {-1.0, 1.0}) {
    Pose pose;
    pose.position = {0.0, 0.5 * sign * (hopper.length_m + hopper.wall_m), 0.5 * hopper.height_m};
    shape.parts.push_back({end, pose});
  }
  return shape;
}

Shape lid(const Hopper& hopper) {
  const double x = 0.5 * hopper.outlet_m + hopper.wall_m;
  const double y = hopper.form == HopperForm::kCone ? x : 0.5 * hopper.length_m + hopper.wall_m;
  Pose pose;
  pose.position.z() = -0.5 * hopper.wall_m;
  return {"lid", {{Box{{x, y, 0.5 * hopper.wall_m}}, pose}}};
}

}  // namespace

Hopper read_hopper(engine::TomlReader in) {
  static const std::string kForms[] = {"cone", "wedge"};
  Hopper hopper;
  hopper.form = in.word("form", kForms, "cone") == 0 ? HopperForm::kCone : HopperForm::kWedge;
  hopper.base_m = in.vector("base_m", hopper.base_m);
  hopper.outlet_m = in.number("outlet_m", Range::kPositive);
  hopper.top_m = in.number("top_m", Range::kPositive);
  if (hopper.top_m < hopper.outlet_m) {
    in.fail("top_m",
            fmt::format("found {}, expected >= outlet_m = {}", hopper.top_m, hopper.outlet_m));
  }
  hopper.height_m = in.number("height_m", Range::kPositive);
  if (hopper.form == HopperForm::kCone) {
    hopper.staves = in.integer("staves", 3, hopper.staves);
  } else {
    hopper.length_m = in.number("length_m", Range::kPositive);
  }
  hopper.wall_m = in.number("wall_m", Range::kPositive);
  hopper.lid = in.boolean("lid", false);
  if (hopper.lid) hopper.lid_motion = in.text("lid_motion", "");
  hopper.material = in.text("material");
  in.finish();
  return hopper;
}

std::string show(const Hopper& hopper) {
  const bool is_cone = hopper.form == HopperForm::kCone;
  return fmt::format("\n[[hoppers]]\nform = \"{}\"\nbase_m = {}\noutlet_m = {}\ntop_m = {}\n",
                     is_cone ? "cone" : "wedge", engine::show(hopper.base_m), hopper.outlet_m,
                     hopper.top_m) +
         (is_cone ? fmt::format("staves = {}\n", hopper.staves)
                  : fmt::format("length_m = {}\n", hopper.length_m)) +
         fmt::format("height_m = {}\nwall_m = {}\nlid = {}\n", hopper.height_m, hopper.wall_m,
                     hopper.lid) +
         (hopper.lid_motion.empty()
              ? ""
              : fmt::format("lid_motion = {}\n", engine::quote(hopper.lid_motion))) +
         fmt::format("material = {}\n", engine::quote(hopper.material));
}

void place(const Hopper& hopper, Nursery& nursery) {
  const bool flat = nursery.dimension() == 2, is_cone = hopper.form == HopperForm::kCone;
  problems::require(!flat || !is_cone, nursery.subject(),
                    "hoppers: form: found cone, expected wedge in a scene of dimension 2");
  Seedling walls;
  walls.solid = nursery.shape(is_cone ? cone(hopper) : wedge(hopper, !flat));
  walls.pose.position = hopper.base_m;
  walls.material = hopper.material;
  walls.fixed = true;
  nursery.add(walls);
  if (!hopper.lid) return;
  Seedling plate = walls;
  plate.solid = nursery.shape(lid(hopper));
  plate.motion = hopper.lid_motion;
  plate.fixed = plate.motion.empty();
  nursery.add(plate);
}

}  // namespace conebench::dem
