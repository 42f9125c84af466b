#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "dem/placement.h"
#include "dem/scene.h"
#include "dem/scene_check.h"
#include "dem/scene_motions.h"
#include "dem/scene_shapes.h"

namespace conebench::dem {
namespace {

using engine::Range;
using engine::TomlReader;

constexpr std::string_view kSides[] = {"-x", "+x", "-y", "+y", "-z", "+z"};

Material read_material(TomlReader in) {
  Material material{in.text("name"), in.number("density_kg_m3", Range::kPositive)};
  in.finish();
  return material;
}

PairLaw read_law(TomlReader& in) {
  static const std::string kDecays[] = {"none", "linear"};
  PairLaw law;
  law.friction = in.number("friction", Range::kNotNegative);
  law.restitution = in.number("restitution", Range::kUnitInterval, 0.0);
  law.tensile_force_N = in.number("tensile_force_N", Range::kNotNegative, 0.0);
  law.rupture_distance_m = in.number("rupture_distance_m", Range::kNotNegative, 0.0);
  law.decay = in.word("decay", kDecays, "none") == 0 ? Decay::kNone : Decay::kLinear;
  law.bonds_form_until_s =
      in.number("bonds_form_until_s", Range::kNotNegative, law.bonds_form_until_s);
  if (law.tensile_force_N > 0.0 && law.friction == 0.0) {
    in.fail("tensile_force_N", "a cohesive pair needs friction > 0, found friction 0");
  }
  if (law.tensile_force_N > 0.0 && law.rupture_distance_m == 0.0) {
    in.fail("rupture_distance_m", "found 0, expected > 0 where tensile_force_N > 0");
  }
  return law;
}

Pair read_pair(TomlReader in) {
  const auto names = in.texts("between", 2);
  Pair pair{names[0], names[1], read_law(in)};
  in.finish();
  return pair;
}

PairLaw read_default_pair(TomlReader in) {
  const PairLaw law = read_law(in);
  in.finish();
  return law;
}

Plane read_plane(TomlReader in) {
  Plane plane;
  plane.point_m = in.vector("point_m", plane.point_m);
  const Eigen::Vector3d normal = in.vector("normal", plane.normal);
  if (normal.norm() == 0.0) in.fail("normal", "found a zero vector, expected a direction");
  // Dividing a unit vector by its rounded length would change its last digit at every reading.
  const bool is_unit = std::abs(normal.norm() - 1.0) < 1e-15;
  plane.normal = is_unit ? normal : normal.normalized();
  plane.material = in.text("material");
  plane.until_s = in.number("until_s", Range::kNotNegative, plane.until_s);
  plane.motion = in.text("motion", "");
  in.finish();
  return plane;
}

Container read_container(TomlReader in) {
  Container container;
  container.low_m = in.vector("low_m");
  container.high_m = in.vector("high_m");
  if (!(container.low_m.array() < container.high_m.array()).all()) {
    in.fail("high_m", "expected above low_m in every direction");
  }
  if (in.has("open")) container.open = in.some_texts("open");
  for (const std::string& side : container.open) {
    if (std::find(std::begin(kSides), std::end(kSides), side) == std::end(kSides)) {
      in.fail("open",
              fmt::format("found \"{}\", expected \"{}\"", side, fmt::join(kSides, "\", \"")));
    }
  }
  container.material = in.text("material");
  container.until_s = in.number("until_s", Range::kNotNegative, container.until_s);
  in.finish();
  return container;
}

void check_still(const TomlReader& in, const Body& body) {
  const std::string detail = std::string(body.fixed ? "a fixed body does not move"
                                                    : "a driven body moves as its motion does") +
                             ", expected [0, 0, 0]";
  if (!body.velocity_m_s.isZero(0.0)) in.fail("velocity_m_s", detail);
  if (!body.angular_velocity_rad_s.isZero(0.0)) in.fail("angular_velocity_rad_s", detail);
}

Body read_body(TomlReader in) {
  Body body;
  body.position_m = in.vector("position_m");
  body.rotation_rad = in.vector("rotation_rad", body.rotation_rad);
  body.shape = in.text("shape", "");
  if (body.shape.empty()) body.radius_m = in.number("radius_m", Range::kPositive);
  body.material = in.text("material");
  body.velocity_m_s = in.vector("velocity_m_s", body.velocity_m_s);
  body.angular_velocity_rad_s = in.vector("angular_velocity_rad_s", body.angular_velocity_rad_s);
  body.fixed = in.boolean("fixed", false);
  body.motion = in.text("motion", "");
  if (body.fixed && !body.motion.empty()) {
    in.fail("motion", "a fixed body does not move, expected fixed = false, or no motion");
  }
  if (body.fixed || !body.motion.empty()) check_still(in, body);
  in.finish();
  return body;
}

template <class T, class... Args>
std::vector<T> read_all(TomlReader& in, std::string_view key, T (*read)(TomlReader, Args...),
                        Args... args) {
  std::vector<T> items;
  for (TomlReader& reader : in.tables(key)) items.push_back(read(std::move(reader), args...));
  return items;
}

void read_generators(TomlReader& in, Scene& scene) {
  scene.columns = read_all(in, "columns", read_column);
  scene.stacks = read_all(in, "stacks", read_stack);
  scene.beds = read_all(in, "beds", read_bed);
  scene.lattices = read_all(in, "lattices", read_lattice);
  scene.depositions = read_all(in, "depositions", read_deposition);
  scene.walls = read_all(in, "walls", read_wall);
  scene.arches = read_all(in, "arches", read_arch);
  scene.towers = read_all(in, "towers", read_tower);
  scene.clumps = read_all(in, "clumps", read_clump);
  scene.hoppers = read_all(in, "hoppers", read_hopper);
  scene.drums = read_all(in, "drums", read_drum);
}

}  // namespace

Scene parse_scene(std::string_view text, std::string_view subject) {
  const toml::table table = engine::parse_toml({std::string(subject), std::string(text)});
  TomlReader in(table, "", std::string(subject));
  Scene scene;
  static_cast<engine::SceneHeader&>(scene) = engine::read_header(in, "dem");
  scene.dimension = static_cast<int>(in.integer("dimension", 2, scene.dimension));
  if (scene.dimension > 3) in.fail("dimension", "expected 2 or 3");
  scene.skin_m = in.number("skin_m", Range::kPositive);
  scene.resolve = in.boolean("resolve", scene.resolve);
  if (auto law = in.table("default_pair")) scene.default_pair = read_default_pair(std::move(*law));
  scene.materials = read_all(in, "materials", read_material);
  scene.pairs = read_all(in, "pairs", read_pair);
  scene.shapes = read_all(in, "shapes", read_shape, subject);
  scene.motions = read_all(in, "motions", read_motion, subject);
  scene.planes = read_all(in, "planes", read_plane);
  scene.containers = read_all(in, "containers", read_container);
  scene.bodies = read_all(in, "bodies", read_body);
  read_generators(in, scene);
  in.finish();
  check_scene(scene, subject);
  place_bodies(scene, subject);
  return scene;
}

}  // namespace conebench::dem
