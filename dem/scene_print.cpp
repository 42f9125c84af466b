#include <fmt/format.h>

#include <cmath>
#include <iterator>

#include "dem/scene.h"

namespace conebench::dem {
namespace {

// Shortest digits that read back as the same double.
std::string show(const Eigen::Vector3d& x) { return fmt::format("[{}, {}, {}]", x[0], x[1], x[2]); }

// A TOML basic string.
std::string quote(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    const auto code = static_cast<unsigned char>(c);
    out += code < 0x20 ? fmt::format("\\u{:04x}", code) : std::string(1, c);
  }
  return out + '"';
}

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
  std::string out = fmt::format(
      "schema = 1\nengine = \"dem\"\nname = {}\ngravity_m_s2 = {}\nstep_s = {}\nduration_s = {}\n"
      "seed = {}\nskin_m = {}\nresolve = {}\n",
      quote(scene.name), show(scene.gravity_m_s2), scene.step_s, scene.duration_s, scene.seed,
      scene.skin_m, scene.resolve);
  out += fmt::format("\n[solver]\nname = {}\ntol = {}\ntime_limit_s = {}\nmax_iterations = {}\n",
                     quote(scene.solver.name), scene.solver.tol, scene.solver.time_limit_s,
                     scene.solver.max_iterations);
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
