#include "dem/generators/arch.h"

#include <fmt/format.h>

#include <cmath>

#include "problems/engine/scene_file.h"

namespace conebench::dem {

using engine::Range;

namespace {

double wedge_rad(const Arch& arch) {
  return arch.embrace_rad / static_cast<double>(arch.voussoirs);
}

// About the middle of the circle, in the middle of the crown.
Shape wedge(const Arch& arch) {
  const double half_angle = 0.5 * wedge_rad(arch);
  Hull hull;
  for (const double side : {-1.0, 1.0}) {
    for (const double end : {-1.0, 1.0}) {
      for (const double half : {-0.5, 0.5}) {
        const double r = arch.mean_radius_m + half * arch.thickness_m;
        hull.points_m.emplace_back(end * r * std::sin(half_angle), 0.5 * side * arch.depth_m,
                                   r * std::cos(half_angle));
      }
    }
  }
  return {"voussoir", {{hull, {}}}};
}

}  // namespace

Arch read_arch(engine::TomlReader in) {
  Arch arch;
  arch.base_m = in.vector("base_m", arch.base_m);
  arch.voussoirs = in.integer("voussoirs", 1);
  arch.mean_radius_m = in.number("mean_radius_m", Range::kPositive);
  arch.thickness_m = in.number("thickness_m", Range::kPositive);
  if (arch.thickness_m >= 2.0 * arch.mean_radius_m) {
    in.fail("thickness_m", fmt::format("found {}, expected less than 2 mean_radius_m = {}",
                                       arch.thickness_m, 2.0 * arch.mean_radius_m));
  }
  arch.depth_m = in.number("depth_m", Range::kPositive);
  arch.embrace_rad = in.number("embrace_rad", Range::kPositive, arch.embrace_rad);
  const double full = arch.embrace_rad + 2.0 * wedge_rad(arch);
  if (full > 2.0 * std::numbers::pi) {
    in.fail("embrace_rad", fmt::format("the arch and its two springers take up {} rad, expected at "
                                       "most a full circle",
                                       full));
  }
  arch.material = in.text("material");
  in.finish();
  return arch;
}

std::string show(const Arch& arch) {
  return fmt::format(
      "\n[[arches]]\nbase_m = {}\nvoussoirs = {}\nmean_radius_m = {}\nthickness_m = {}\n"
      "depth_m = {}\nembrace_rad = {}\nmaterial = {}\n",
      engine::show(arch.base_m), arch.voussoirs, arch.mean_radius_m, arch.thickness_m, arch.depth_m,
      arch.embrace_rad, engine::quote(arch.material));
}

void place(const Arch& arch, Nursery& nursery) {
  Seedling stone;
  stone.solid = nursery.shape(wedge(arch));
  stone.material = arch.material;
  stone.pose.position = arch.base_m;
  stone.pose.position.z() -= arch.mean_radius_m * std::cos(0.5 * arch.embrace_rad);
  for (std::int64_t i = -1; i <= arch.voussoirs; ++i) {
    const double angle = (static_cast<double>(i) + 0.5) * wedge_rad(arch) - 0.5 * arch.embrace_rad;
    stone.pose.orientation = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY());
    stone.fixed = i < 0 || i == arch.voussoirs;
    nursery.add(stone);
  }
}

}  // namespace conebench::dem
