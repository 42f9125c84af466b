#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>

#include "dem/scene.h"
#include "dem/scene_motions.h"
#include "dem/scene_shapes.h"

namespace conebench::dem {
namespace {

using engine::quote;
using engine::show;

std::string show(const PairLaw& law) {
  return fmt::format(
             "friction = {}\nrestitution = {}\ntensile_force_N = {}\nrupture_distance_m = {}\n"
             "decay = \"{}\"\n",
             law.friction, law.restitution, law.tensile_force_N, law.rupture_distance_m,
             law.decay == Decay::kNone ? "none" : "linear") +
         (std::isfinite(law.bonds_form_until_s)
              ? fmt::format("bonds_form_until_s = {}\n", law.bonds_form_until_s)
              : "");
}

std::string show(const Material& material) {
  return fmt::format("\n[[materials]]\nname = {}\ndensity_kg_m3 = {}\n", quote(material.name),
                     material.density_kg_m3);
}

std::string show(const Pair& pair) {
  return fmt::format("\n[[pairs]]\nbetween = [{}, {}]\n", quote(pair.first), quote(pair.second)) +
         show(pair.law);
}

std::string show_until(double until_s) {
  return std::isfinite(until_s) ? fmt::format("until_s = {}\n", until_s) : "";
}

std::string show_motion(const std::string& motion) {
  return motion.empty() ? "" : fmt::format("motion = {}\n", quote(motion));
}

std::string show(const Plane& plane) {
  return fmt::format("\n[[planes]]\npoint_m = {}\nnormal = {}\nmaterial = {}\n",
                     show(plane.point_m), show(plane.normal), quote(plane.material)) +
         show_until(plane.until_s) + show_motion(plane.motion);
}

std::string show(const Container& container) {
  std::string out =
      fmt::format("\n[[containers]]\nlow_m = {}\nhigh_m = {}\nmaterial = {}\n",
                  show(container.low_m), show(container.high_m), quote(container.material));
  if (!container.open.empty()) {
    out += fmt::format("open = [\"{}\"]\n", fmt::join(container.open, "\", \""));
  }
  return out + show_until(container.until_s);
}

std::string show(const Body& body) {
  return fmt::format("\n[[bodies]]\nposition_m = {}\nrotation_rad = {}\n", show(body.position_m),
                     show(body.rotation_rad)) +
         (body.shape.empty() ? fmt::format("radius_m = {}\n", body.radius_m)
                             : fmt::format("shape = {}\n", quote(body.shape))) +
         fmt::format("material = {}\nvelocity_m_s = {}\nangular_velocity_rad_s = {}\nfixed = {}\n",
                     quote(body.material), show(body.velocity_m_s),
                     show(body.angular_velocity_rad_s), body.fixed) +
         show_motion(body.motion);
}

template <class Item>
void append(std::string& out, const std::vector<Item>& items) {
  for (const Item& item : items) out += show(item);
}

}  // namespace

std::string to_toml(const Scene& scene) {
  std::string out = engine::print_header(scene, "dem",
                                         fmt::format("dimension = {}\nskin_m = {}\nresolve = {}\n",
                                                     scene.dimension, scene.skin_m, scene.resolve));
  if (scene.default_pair) out += "\n[default_pair]\n" + show(*scene.default_pair);
  append(out, scene.materials);
  append(out, scene.pairs);
  append(out, scene.shapes);
  append(out, scene.motions);
  append(out, scene.planes);
  append(out, scene.containers);
  append(out, scene.bodies);
  append(out, scene.columns);
  append(out, scene.stacks);
  append(out, scene.beds);
  append(out, scene.lattices);
  append(out, scene.depositions);
  append(out, scene.walls);
  append(out, scene.arches);
  append(out, scene.towers);
  append(out, scene.clumps);
  append(out, scene.hoppers);
  append(out, scene.drums);
  return out;
}

}  // namespace conebench::dem
