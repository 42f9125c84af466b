#include <fmt/format.h>

#include <cmath>
#include <set>

#include "dem/placement.h"
#include "dem/scene.h"
#include "problems/error.h"
#include "problems/suggest.h"

namespace conebench::dem {
namespace {

using engine::Range;
using engine::TomlReader;
using problems::InputError;
using problems::require;

Material read_material(TomlReader in) {
  Material material{in.text("name"), in.number("density_kg_m3", Range::kPositive)};
  in.finish();
  return material;
}

PairLaw read_law(TomlReader& in) {
  PairLaw law;
  law.friction = in.number("friction", Range::kNotNegative);
  law.restitution = in.number("restitution", Range::kUnitInterval, 0.0);
  law.tensile_force_N = in.number("tensile_force_N", Range::kNotNegative, 0.0);
  law.rupture_distance_m = in.number("rupture_distance_m", Range::kNotNegative, 0.0);
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
  in.finish();
  return plane;
}

Body read_body(TomlReader in) {
  Body body;
  body.position_m = in.vector("position_m");
  body.radius_m = in.number("radius_m", Range::kPositive);
  body.material = in.text("material");
  body.velocity_m_s = in.vector("velocity_m_s", body.velocity_m_s);
  body.angular_velocity_rad_s = in.vector("angular_velocity_rad_s", body.angular_velocity_rad_s);
  body.fixed = in.boolean("fixed", false);
  if (body.fixed && !body.velocity_m_s.isZero(0.0)) {
    in.fail("velocity_m_s", "a fixed body does not move, expected [0, 0, 0]");
  }
  if (body.fixed && !body.angular_velocity_rad_s.isZero(0.0)) {
    in.fail("angular_velocity_rad_s", "a fixed body does not turn, expected [0, 0, 0]");
  }
  in.finish();
  return body;
}

Column read_column(TomlReader in) {
  Column column;
  const std::string section = in.text("section", "box");
  if (section != "box" && section != "cylinder") {
    in.fail("section", fmt::format("found \"{}\", expected \"box\" or \"cylinder\"", section));
  }
  column.section = section == "box" ? Section::kBox : Section::kCylinder;
  column.base_m = in.vector("base_m", column.base_m);
  column.width_m = in.number("width_m", Range::kPositive);
  column.height_m = in.number("height_m", Range::kPositive);
  const Eigen::Vector2d radii = in.interval("radius_range_m", Range::kPositive);
  column.smallest_radius_m = radii[0];
  column.largest_radius_m = radii[1];
  column.jitter = in.number("jitter", Range::kUnitInterval, column.jitter);
  column.material = in.text("material");
  if (std::min(column.width_m, column.height_m) < 2.0 * column.largest_radius_m) {
    in.fail("radius_range_m", "the largest sphere does not fit into width_m x height_m");
  }
  in.finish();
  return column;
}

Stack read_stack(TomlReader in) {
  Stack stack;
  stack.base_m = in.vector("base_m", stack.base_m);
  stack.count = in.integer("count", 1);
  stack.radius_m = in.number("radius_m", Range::kPositive);
  stack.material = in.text("material");
  in.finish();
  return stack;
}

Bed read_bed(TomlReader in) {
  Bed bed;
  bed.centre_m = in.vector("centre_m", bed.centre_m);
  bed.width_m = in.number("width_m", Range::kPositive);
  bed.radius_m = in.number("radius_m", Range::kPositive);
  bed.material = in.text("material");
  in.finish();
  return bed;
}

template <class T>
std::vector<T> read_all(TomlReader& in, std::string_view key, T (*read)(TomlReader)) {
  std::vector<T> items;
  for (TomlReader& reader : in.tables(key)) items.push_back(read(std::move(reader)));
  return items;
}

void check_materials(const Scene& scene, std::string_view subject) {
  std::set<std::string> names;
  for (const Material& material : scene.materials) {
    require(names.insert(material.name).second, subject, "materials: \"", material.name,
            "\" is there twice");
  }
  const auto known = [&](const std::string& name, std::string_view where) {
    if (names.contains(name)) return;
    const std::vector<std::string> candidates(names.begin(), names.end());
    throw InputError(subject, fmt::format("{}: no material \"{}\"{}", where, name,
                                          problems::suggestion(name, candidates)));
  };
  for (const auto& pair : scene.pairs) {
    known(pair.first, "pairs");
    known(pair.second, "pairs");
  }
  for (const auto& plane : scene.planes) known(plane.material, "planes");
  for (const auto& body : scene.bodies) known(body.material, "bodies");
  for (const auto& column : scene.columns) known(column.material, "columns");
  for (const auto& stack : scene.stacks) known(stack.material, "stacks");
  for (const auto& bed : scene.beds) known(bed.material, "beds");
}

// Every two materials that can meet have a law.
void check_laws(const Scene& scene, std::string_view subject) {
  std::set<std::string> of_bodies;
  std::set<std::string> of_all;
  for (const auto& body : scene.bodies) (body.fixed ? of_all : of_bodies).insert(body.material);
  for (const auto& column : scene.columns) of_bodies.insert(column.material);
  for (const auto& stack : scene.stacks) of_bodies.insert(stack.material);
  of_all.insert(of_bodies.begin(), of_bodies.end());
  for (const auto& bed : scene.beds) of_all.insert(bed.material);
  for (const auto& plane : scene.planes) of_all.insert(plane.material);
  for (const std::string& first : of_bodies) {
    for (const std::string& second : of_all) {
      require(law_between(scene, first, second).has_value(), subject, "pairs: no law between \"",
              first, "\" and \"", second, "\", expected a [[pairs]] or [default_pair] for them");
    }
  }
}

}  // namespace

Scene parse_scene(std::string_view text, std::string_view subject) {
  const toml::table table = engine::parse_toml({std::string(subject), std::string(text)});
  TomlReader in(table, "", std::string(subject));
  Scene scene;
  static_cast<engine::SceneHeader&>(scene) = engine::read_header(in, "dem");
  scene.skin_m = in.number("skin_m", Range::kPositive);
  scene.resolve = in.boolean("resolve", scene.resolve);
  if (auto law = in.table("default_pair")) scene.default_pair = read_default_pair(std::move(*law));
  scene.materials = read_all(in, "materials", read_material);
  scene.pairs = read_all(in, "pairs", read_pair);
  scene.planes = read_all(in, "planes", read_plane);
  scene.bodies = read_all(in, "bodies", read_body);
  scene.columns = read_all(in, "columns", read_column);
  scene.stacks = read_all(in, "stacks", read_stack);
  scene.beds = read_all(in, "beds", read_bed);
  in.finish();
  check_materials(scene, subject);
  check_laws(scene, subject);
  place_spheres(scene, subject);
  return scene;
}

}  // namespace conebench::dem
