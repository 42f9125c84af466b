#include <fmt/format.h>

#include <cmath>

#include "mpm/scene.h"
#include "mpm/scene_check.h"

namespace conebench::mpm {
namespace {

using engine::Range;
using engine::TomlReader;

constexpr std::array kLaws = {Law::kUniform, Law::kDenseOnly, Law::kDilationAware, Law::kMonotone};
constexpr std::array kRefines = {Refine::kNone, Refine::kBoundary};
constexpr std::array kWallConditions = {Condition::kStick, Condition::kSlip, Condition::kFree,
                                        Condition::kFrictional};
constexpr std::array kBarrierConditions = {Condition::kStick, Condition::kSlip};
constexpr std::array kShapes = {Shape::kBall, Shape::kBox, Shape::kHalfSpace};
constexpr std::array kMotions = {Motion::kStatic, Motion::kDriven, Motion::kFree};

template <class Word, std::size_t N>
Word read_word(TomlReader& in, std::string_view key, const std::array<Word, N>& words,
               std::optional<Word> fallback = {}) {
  std::vector<std::string> names;
  names.reserve(N);
  for (const Word word : words) names.emplace_back(to_string(word));
  if (!fallback) return words[in.word(key, names)];
  return words[in.word(key, names, std::string(to_string(*fallback)))];
}

// As many entries as the grid has dimensions; the others are 0. `fallback` is that of every entry.
Eigen::Vector3d read_vector(TomlReader& in, std::string_view key, int dim, Range range,
                            std::optional<double> fallback = {}) {
  const auto count = static_cast<std::size_t>(dim);
  std::optional<std::vector<double>> missing;
  if (fallback) missing.emplace(count, *fallback);
  const std::vector<double> values = in.numbers(key, count, range, missing);
  Eigen::Vector3d x = Eigen::Vector3d::Zero();
  std::copy(values.begin(), values.end(), x.begin());
  return x;
}

// A velocity or gravity: three entries, the third 0 in two dimensions.
Eigen::Vector3d read_velocity(TomlReader& in, std::string_view key, int dim,
                              const Eigen::Vector3d& fallback) {
  Eigen::Vector3d x = in.vector(key, fallback);
  if (dim == 2 && x.z() != 0.0) {
    in.fail(key, fmt::format("found {}, expected a third entry of 0 in two dimensions",
                             engine::show(x)));
  }
  return x;
}

TomlReader need_table(TomlReader& in, std::string_view key) {
  auto table = in.table(key);
  if (!table) in.fail(key, "missing, expected a table");
  return std::move(*table);
}

Grid read_grid(TomlReader in) {
  constexpr double kMostNodes = std::numeric_limits<int>::max();
  const auto cells = in.integers("cells", 2, 3, 1);
  Grid grid;
  grid.refine = read_word(in, "refine", kRefines, std::optional(grid.refine));
  const double halves = grid.refine == Refine::kNone ? 1.0 : 2.0;
  double nodes = 1.0;
  for (const std::int64_t count : cells) nodes *= halves * static_cast<double>(count) + 1.0;
  if (nodes > kMostNodes) {
    in.fail("cells", fmt::format("found {} nodes, expected at most {}", nodes, kMostNodes));
  }
  grid.dim = static_cast<int>(cells.size());
  for (int a = 0; a < grid.dim; ++a) {
    grid.cells[a] = static_cast<int>(cells[static_cast<std::size_t>(a)]);
  }
  grid.size_m = read_vector(in, "size_m", grid.dim, Range::kPositive);
  grid.low_m = read_vector(in, "low_m", grid.dim, Range::kAny, 0.0);
  in.finish();
  return grid;
}

Material read_material(TomlReader in) {
  Material material;
  material.density_kg_m3 = in.number("density_kg_m3", Range::kPositive);
  material.phi_max = in.number("phi_max", Range::kPositiveShare, material.phi_max);
  material.friction = in.number("friction", Range::kNotNegative);
  material.cohesion_Pa = in.number("cohesion_Pa", Range::kNotNegative, material.cohesion_Pa);
  material.law = read_word(in, "law", kLaws, std::optional(material.law));
  material.cohesion_decay =
      in.number("cohesion_decay", Range::kNotNegative, material.cohesion_decay);
  material.friction_rise = in.number("friction_rise", Range::kNotNegative, material.friction_rise);
  material.inertial_number_0 =
      in.number("inertial_number_0", Range::kPositive, material.inertial_number_0);
  material.grain_diameter_m =
      in.number("grain_diameter_m", Range::kNotNegative, material.grain_diameter_m);
  material.viscosity_Pa_s =
      in.number("viscosity_Pa_s", Range::kNotNegative, material.viscosity_Pa_s);
  material.viscosity_in_mass = in.boolean("viscosity_in_mass", material.viscosity_in_mass);
  in.finish();
  if (material.cohesion_Pa > 0.0 && material.friction == 0.0) {
    in.fail("friction", "found 0, expected a number > 0 where cohesion_Pa > 0");
  }
  if (material.friction_rise > 0.0 && material.grain_diameter_m == 0.0) {
    in.fail("grain_diameter_m", "found 0, expected a number > 0 where friction_rise > 0");
  }
  return material;
}

// Either "slip" or { condition = "frictional", friction = 0.3 }.
Wall read_wall(TomlReader& walls, std::string_view face) {
  Wall wall;
  if (!walls.has_table(face)) {
    wall.condition = read_word(walls, face, kWallConditions, std::optional(wall.condition));
    if (wall.condition == Condition::kFrictional) {
      walls.fail(face,
                 "found \"frictional\" without a coefficient, expected "
                 "{ condition = \"frictional\", friction = 0.3 }");
    }
    return wall;
  }
  TomlReader in = *walls.table(face);
  wall.condition = read_word(in, "condition", kWallConditions);
  if (wall.condition == Condition::kFrictional) {
    wall.friction = in.number("friction", Range::kNotNegative);
  } else if (in.has("friction")) {
    in.fail("friction", fmt::format("found {}, expected none: the wall's condition is \"{}\"",
                                    in.number("friction", Range::kAny), to_string(wall.condition)));
  }
  in.finish();
  return wall;
}

std::array<Wall, 6> read_walls(TomlReader in, int dim) {
  std::array<Wall, 6> walls;
  for (int face = 0; face < 2 * dim; ++face) {
    walls[static_cast<std::size_t>(face)] = read_wall(in, face_name(dim, face));
  }
  in.finish();
  return walls;
}

Barrier read_barrier(TomlReader in, const Scene& scene) {
  const int dim = scene.grid.dim;
  std::vector<std::string> axes = {"x", "y", "z"};
  axes.resize(static_cast<std::size_t>(dim));
  Barrier barrier;
  barrier.axis = static_cast<int>(in.word("axis", axes));
  barrier.position_m = in.number("position_m", Range::kAny);
  barrier.low_m = read_vector(in, "low_m", dim, Range::kAny);
  barrier.high_m = read_vector(in, "high_m", dim, Range::kAny);
  barrier.condition =
      read_word(in, "condition", kBarrierConditions, std::optional(barrier.condition));
  barrier.opens_s = in.number("opens_s", Range::kNotNegative, barrier.opens_s);
  barrier.opening_m_s = in.number("opening_m_s", Range::kNotNegative, barrier.opening_m_s);
  in.finish();
  check_barrier(in, scene, barrier);
  return barrier;
}

Block read_block(TomlReader in, const Scene& scene) {
  const int dim = scene.grid.dim;
  Block block;
  block.low_m = read_vector(in, "low_m", dim, Range::kAny);
  block.high_m = read_vector(in, "high_m", dim, Range::kAny);
  block.fraction = in.number("fraction", Range::kPositive, scene.material.phi_max);
  block.particles_per_cell = in.integer("particles_per_cell", 1, block.particles_per_cell);
  block.jitter = in.number("jitter", Range::kUnitInterval, block.jitter);
  block.cohesion_factor = in.number("cohesion_factor", Range::kNotNegative, block.cohesion_factor);
  block.velocity_m_s = read_velocity(in, "velocity_m_s", dim, block.velocity_m_s);
  in.finish();
  check_block(in, scene, block);
  return block;
}

void read_shape(TomlReader& in, int dim, Body& body) {
  body.shape = read_word(in, "shape", kShapes);
  switch (body.shape) {
    case Shape::kBall:
      body.radius_m = in.number("radius_m", Range::kPositive);
      return;
    case Shape::kBox:
      body.half_size_m = read_vector(in, "half_size_m", dim, Range::kPositive);
      return;
    case Shape::kHalfSpace:
      body.normal = read_vector(in, "normal", dim, Range::kAny);
      break;
  }
  const double length = body.normal.norm();
  if (length == 0.0) in.fail("normal", "found a zero vector, expected a direction");
  // Dividing a unit vector by its rounded length would change its last digit at every reading.
  if (std::abs(length - 1.0) >= 1e-15) body.normal /= length;
}

Body read_body(TomlReader in, const Scene& scene) {
  const int dim = scene.grid.dim;
  Body body;
  read_shape(in, dim, body);
  body.motion = read_word(in, "motion", kMotions);
  body.centre_m = read_vector(in, "centre_m", dim, Range::kAny);
  body.rotation_rad = in.vector("rotation_rad", body.rotation_rad);
  body.velocity_m_s = read_velocity(in, "velocity_m_s", dim, body.velocity_m_s);
  body.angular_velocity_rad_s = in.vector("angular_velocity_rad_s", body.angular_velocity_rad_s);
  if (body.motion == Motion::kFree) {
    body.density_kg_m3 = in.number("density_kg_m3", Range::kPositive);
  } else if (in.has("density_kg_m3")) {
    in.fail("density_kg_m3",
            fmt::format("found {}, expected none: the body's motion is \"{}\"",
                        in.number("density_kg_m3", Range::kAny), to_string(body.motion)));
  }
  body.friction = in.number("friction", Range::kNotNegative, body.friction);
  in.finish();
  check_body(in, scene.grid, body);
  return body;
}

// A part can be checked against those before it.
template <class Part>
void read_all(TomlReader& in, std::string_view key, Part (*read)(TomlReader, const Scene&),
              const Scene& scene, std::vector<Part>& parts) {
  for (TomlReader& reader : in.tables(key)) parts.push_back(read(std::move(reader), scene));
}

}  // namespace

Scene parse_scene(std::string_view text, std::string_view subject) {
  const toml::table table = engine::parse_toml({std::string(subject), std::string(text)});
  TomlReader in(table, "", std::string(subject));
  Scene scene;
  static_cast<engine::SceneHeader&>(scene) = engine::read_header(in, "mpm");
  scene.cfl = in.number("cfl", Range::kPositiveShare, scene.cfl);
  scene.grid = read_grid(need_table(in, "grid"));
  const Eigen::Vector3d down =
      scene.grid.dim == 2 ? Eigen::Vector3d(0.0, -9.81, 0.0) : scene.gravity_m_s2;
  scene.gravity_m_s2 = read_velocity(in, "gravity_m_s2", scene.grid.dim, down);
  scene.material = read_material(need_table(in, "material"));
  if (auto walls = in.table("walls")) scene.walls = read_walls(std::move(*walls), scene.grid.dim);
  read_all(in, "barriers", read_barrier, scene, scene.barriers);
  read_all(in, "blocks", read_block, scene, scene.blocks);
  read_all(in, "bodies", read_body, scene, scene.bodies);
  in.finish();
  if (scene.blocks.empty()) in.fail("blocks", "found none, expected at least one: no particles");
  return scene;
}

}  // namespace conebench::mpm
