#pragma once

#include <Eigen/Core>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "problems/engine/scene_file.h"

namespace conebench::dem {

struct Material {
  std::string name;
  double density_kg_m3 = 0.0;  ///< > 0
};

/// What happens where two materials touch.
struct PairLaw {
  double friction = 0.0;         ///< Coulomb coefficient [-], >= 0; 0 makes a cone of dimension 1
  double restitution = 0.0;      ///< Newton's e [-], 0 <= e <= 1
  double tensile_force_N = 0.0;  ///< strength of a bond, >= 0; needs friction > 0
  double rupture_distance_m = 0.0;  ///< gap at which a bond breaks, > 0 where there are bonds
};

struct Pair {
  std::string first, second;  ///< names of materials, in either order
  PairLaw law;
};

/// An infinite wall; the bodies are on the side that `normal` points to.
struct Plane {
  Eigen::Vector3d point_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< unit length
  std::string material;
  double until_s = std::numeric_limits<double>::infinity();  ///< taken away at this time
};

/// A sphere.
struct Body {
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;  ///< > 0
  std::string material;
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity_rad_s = Eigen::Vector3d::Zero();
  bool fixed = false;  ///< held in place: no degrees of freedom
};

enum class Section { kBox, kCylinder };

/// Generator: spheres of random radii on a cubic lattice of spacing 2 max(radius), each moved at
/// random in the room that its cell leaves it, layer by layer from the base upwards.
struct Column {
  Section section = Section::kBox;
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();  ///< centre of the base; the axis is z
  double width_m = 0.0;                              ///< side of the square, or diameter
  double height_m = 0.0;
  double smallest_radius_m = 0.0;
  double largest_radius_m = 0.0;
  double jitter = 1.0;  ///< share of the free room that is used [-], 0..1
  std::string material;
};

/// Generator: equal spheres that touch, one on top of the other along z.
struct Stack {
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();  ///< where the lowest sphere touches the ground
  std::int64_t count = 0;
  double radius_m = 0.0;
  std::string material;
};

/// Generator: a rough floor of equal spheres held in place on a square lattice, touching.
struct Bed {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< of the layer: all centres at its z
  double width_m = 0.0;                                ///< side of the square that is covered
  double radius_m = 0.0;
  std::string material;
};

/// A simulation as it is written in a scene file (TOML, SI units in the key names).
struct Scene : engine::SceneHeader {
  double skin_m = 0.0;   ///< contacts with a smaller gap are looked at, > 0
  bool resolve = false;  ///< push overlapping spheres apart instead of refusing them
  std::vector<Material> materials;
  std::optional<PairLaw> default_pair;  ///< for materials that no pair names
  std::vector<Pair> pairs;
  std::vector<Plane> planes;
  std::vector<Body> bodies;
  std::vector<Column> columns;
  std::vector<Stack> stacks;
  std::vector<Bed> beds;
};

/// Index of a material. Throws InputError naming it and the known ones.
int material_index(const Scene& scene, std::string_view name);

/// The law between two materials, or nothing when neither a pair nor a default gives one.
std::optional<PairLaw> law_between(const Scene& scene, std::string_view first,
                                   std::string_view second);

/// Reads a scene. `subject` is what errors call it: the file's name.
/// Errors: InputError with line, key, found and expected; an unknown key comes with a suggestion.
/// A scene that parses can be simulated: materials, laws and overlaps are checked too.
Scene parse_scene(std::string_view text, std::string_view subject);

/// A built-in scene by its name, or a scene file by its path.
Scene load_scene(const std::string& name_or_path);

/// The files of dem/scenes, in alphabetical order.
std::span<const engine::BuiltinScene> builtin_scenes();

/// The full scene with every default, as a scene file; parse_scene() reads the same scene back.
std::string to_toml(const Scene& scene);

}  // namespace conebench::dem
