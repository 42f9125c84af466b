#include <fmt/format.h>

#include <cmath>

#include "mpm/scene.h"

namespace conebench::mpm {
namespace {

using engine::show;

std::string show(const Grid& grid) {
  return fmt::format("\n[grid]\ncells = [{}]\nsize_m = {}\nlow_m = {}\nrefine = \"{}\"\n",
                     fmt::join(grid.cells.data(), grid.cells.data() + grid.dim, ", "),
                     show(grid.size_m, grid.dim), show(grid.low_m, grid.dim),
                     to_string(grid.refine));
}

std::string show(const Material& material) {
  return fmt::format(
      "\n[material]\ndensity_kg_m3 = {}\nphi_max = {}\nfriction = {}\ncohesion_Pa = {}\n"
      "law = \"{}\"\ncohesion_decay = {}\nfriction_rise = {}\ninertial_number_0 = {}\n"
      "grain_diameter_m = {}\nviscosity_Pa_s = {}\nviscosity_in_mass = {}\n",
      material.density_kg_m3, material.phi_max, material.friction, material.cohesion_Pa,
      to_string(material.law), material.cohesion_decay, material.friction_rise,
      material.inertial_number_0, material.grain_diameter_m, material.viscosity_Pa_s,
      material.viscosity_in_mass);
}

std::string show(const Wall& wall) {
  const std::string_view condition = to_string(wall.condition);
  if (wall.condition != Condition::kFrictional) return fmt::format("\"{}\"", condition);
  return fmt::format("{{ condition = \"{}\", friction = {} }}", condition, wall.friction);
}

std::string show_walls(const Scene& scene) {
  std::string out = "\n[walls]\n";
  for (int face = 0; face < 2 * scene.grid.dim; ++face) {
    out += fmt::format("{} = {}\n", face_name(scene.grid.dim, face),
                       show(scene.walls[static_cast<std::size_t>(face)]));
  }
  return out;
}

std::string show(const Barrier& barrier, int dim) {
  std::string out = fmt::format(
      "\n[[barriers]]\naxis = \"{}\"\nposition_m = {}\nlow_m = {}\nhigh_m = {}\n"
      "condition = \"{}\"\n",
      "xyz"[barrier.axis], barrier.position_m, show(barrier.low_m, dim), show(barrier.high_m, dim),
      to_string(barrier.condition));
  if (!std::isfinite(barrier.opens_s)) return out;
  return out +
         fmt::format("opens_s = {}\nopening_m_s = {}\n", barrier.opens_s, barrier.opening_m_s);
}

std::string show(const Block& block, int dim) {
  return fmt::format(
      "\n[[blocks]]\nlow_m = {}\nhigh_m = {}\nfraction = {}\nparticles_per_cell = {}\n"
      "jitter = {}\ncohesion_factor = {}\nvelocity_m_s = {}\n",
      show(block.low_m, dim), show(block.high_m, dim), block.fraction, block.particles_per_cell,
      block.jitter, block.cohesion_factor, show(block.velocity_m_s));
}

std::string show_shape(const Body& body, int dim) {
  switch (body.shape) {
    case Shape::kBall:
      return fmt::format("radius_m = {}\n", body.radius_m);
    case Shape::kBox:
      return fmt::format("half_size_m = {}\n", show(body.half_size_m, dim));
    case Shape::kHalfSpace:
      return fmt::format("normal = {}\n", show(body.normal, dim));
  }
  return {};
}

std::string show(const Body& body, int dim) {
  const std::string density =
      body.motion == Motion::kFree ? fmt::format("density_kg_m3 = {}\n", body.density_kg_m3) : "";
  return fmt::format(
      "\n[[bodies]]\nshape = \"{}\"\n{}motion = \"{}\"\ncentre_m = {}\nrotation_rad = {}\n"
      "velocity_m_s = {}\nangular_velocity_rad_s = {}\n{}friction = {}\n",
      to_string(body.shape), show_shape(body, dim), to_string(body.motion),
      show(body.centre_m, dim), show(body.rotation_rad), show(body.velocity_m_s),
      show(body.angular_velocity_rad_s), density, body.friction);
}

}  // namespace

std::string to_toml(const Scene& scene) {
  const int dim = scene.grid.dim;
  std::string out = engine::print_header(scene, "mpm", fmt::format("cfl = {}\n", scene.cfl));
  out += show(scene.grid) + show(scene.material) + show_walls(scene);
  for (const Barrier& barrier : scene.barriers) out += show(barrier, dim);
  for (const Block& block : scene.blocks) out += show(block, dim);
  for (const Body& body : scene.bodies) out += show(body, dim);
  return out;
}

}  // namespace conebench::mpm
