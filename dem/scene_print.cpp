#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "dem/scene.h"

namespace conebench::dem {
namespace {

using engine::quote;
using engine::show;

std::string show(const PairLaw& law) {
  return fmt::format(
      "friction = {}\nrestitution = {}\ntensile_force_N = {}\nrupture_distance_m = {}\n",
      law.friction, law.restitution, law.tensile_force_N, law.rupture_distance_m);
}

std::string show(const Material& material) {
  return fmt::format("\n[[materials]]\nname = {}\ndensity_kg_m3 = {}\n", quote(material.name),
                     material.density_kg_m3);
}

std::string show(const Pair& pair) {
  return fmt::format("\n[[pairs]]\nbetween = [{}, {}]\n", quote(pair.first), quote(pair.second)) +
         show(pair.law);
}

std::string show(const Plane& plane) {
  const std::string until =
      std::isfinite(plane.until_s) ? fmt::format("until_s = {}\n", plane.until_s) : "";
  return fmt::format("\n[[planes]]\npoint_m = {}\nnormal = {}\nmaterial = {}\n",
                     show(plane.point_m), show(plane.normal), quote(plane.material)) +
         until;
}

std::string show(const Body& body) {
  return fmt::format(
      "\n[[bodies]]\nposition_m = {}\nradius_m = {}\nmaterial = {}\nvelocity_m_s = {}\n"
      "angular_velocity_rad_s = {}\nfixed = {}\n",
      show(body.position_m), body.radius_m, quote(body.material), show(body.velocity_m_s),
      show(body.angular_velocity_rad_s), body.fixed);
}

std::string show(const Column& column) {
  return fmt::format(
      "\n[[columns]]\nsection = \"{}\"\nbase_m = {}\nwidth_m = {}\nheight_m = {}\n"
      "radius_range_m = [{}, {}]\njitter = {}\nmaterial = {}\n",
      column.section == Section::kBox ? "box" : "cylinder", show(column.base_m), column.width_m,
      column.height_m, column.smallest_radius_m, column.largest_radius_m, column.jitter,
      quote(column.material));
}

std::string show(const Stack& stack) {
  return fmt::format("\n[[stacks]]\nbase_m = {}\ncount = {}\nradius_m = {}\nmaterial = {}\n",
                     show(stack.base_m), stack.count, stack.radius_m, quote(stack.material));
}

std::string show(const Bed& bed) {
  return fmt::format("\n[[beds]]\ncentre_m = {}\nwidth_m = {}\nradius_m = {}\nmaterial = {}\n",
                     show(bed.centre_m), bed.width_m, bed.radius_m, quote(bed.material));
}

template <class Item>
void append(std::string& out, const std::vector<Item>& items) {
  for (const Item& item : items) out += show(item);
}

}  // namespace

std::string to_toml(const Scene& scene) {
  std::string out = engine::print_header(
      scene, "dem", fmt::format("skin_m = {}\nresolve = {}\n", scene.skin_m, scene.resolve));
  if (scene.default_pair) out += "\n[default_pair]\n" + show(*scene.default_pair);
  append(out, scene.materials);
  append(out, scene.pairs);
  append(out, scene.planes);
  append(out, scene.bodies);
  append(out, scene.columns);
  append(out, scene.stacks);
  append(out, scene.beds);
  return out;
}

}  // namespace conebench::dem
