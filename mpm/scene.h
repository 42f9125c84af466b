#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "mpm/grid.h"
#include "problems/engine/scene_file.h"

namespace conebench::mpm {

/// Which nodes cohesion acts on; cohesion_law.h says what each means.
enum class Law { kUniform, kDenseOnly, kDilationAware, kMonotone };
std::string_view to_string(Law law);
std::string_view to_string(Refine refine);

/// One granular material: Drucker-Prager sqrt(J2) <= friction p + cohesion, no dilatancy. Stress
/// and cohesion are per volume of solid: the bulk carries phi times as much.
struct Material {
  double density_kg_m3 = 0.0;      ///< of the grains, > 0
  double phi_max = 1.0;            ///< largest volume fraction, 0 < phi_max <= 1
  double friction = 0.0;           ///< mu [-], >= 0; 2D: the sine of the friction angle
  double cohesion_Pa = 0.0;        ///< c, shear strength at zero pressure, >= 0; needs friction > 0
  Law law = Law::kMonotone;        ///< where the cohesion acts
  double cohesion_decay = 0.0;     ///< c <- c exp(-decay x shear strain), >= 0 [-]
  double friction_rise = 0.0;      ///< mu(I) = friction + rise / (1 + I0 / I), >= 0 [-]
  double inertial_number_0 = 0.3;  ///< I0 > 0 [-]
  double grain_diameter_m = 0.0;   ///< > 0 where friction_rise > 0
  double viscosity_Pa_s = 0.0;     ///< Newtonian part, implicit, >= 0
  bool viscosity_in_mass = false;  ///< keep it in M instead of splitting it off before the cones
};

/// What holds the velocity at a wall.
enum class Condition {
  kStick,       ///< v = 0
  kSlip,        ///< v . n = 0, no shear stress
  kFree,        ///< nothing; what crosses leaves the simulation
  kFrictional,  ///< a Coulomb cone at every node; may open
};
std::string_view to_string(Condition condition);

/// One face of the grid.
struct Wall {
  Condition condition = Condition::kSlip;
  double friction = 0.0;  ///< of a frictional wall, >= 0
};

/// Name of a face in the order of Scene::walls: left, right, bottom, top in two dimensions; left,
/// right, front, back, bottom, top in three, where up is z and front is where y is low.
std::string_view face_name(int dim, int face);

/// A thin wall inside the grid, on a plane of nodes: a door, a shelf, the floor of a silo.
struct Barrier {
  int axis = 0;                                     ///< of its normal
  double position_m = 0.0;                          ///< along that axis; on a plane of nodes
  Eigen::Vector3d low_m = Eigen::Vector3d::Zero();  ///< its rectangle (the axis' entry is unused)
  Eigen::Vector3d high_m = Eigen::Vector3d::Zero();
  Condition condition = Condition::kSlip;  ///< stick or slip
  double opens_s = std::numeric_limits<double>::infinity();
  double opening_m_s = 0.0;  ///< lower edge rises against gravity at this speed; 0: gone at once
};

/// A box of material at the start. Particles that would lie inside a body are not placed.
struct Block {
  Eigen::Vector3d low_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d high_m = Eigen::Vector3d::Zero();
  double fraction = 0.0;                ///< initial volume fraction, 0 < fraction <= phi_max
  std::int64_t particles_per_cell = 2;  ///< along each axis
  double jitter = 0.0;           ///< share of a particle's room that it is moved in [-], 0..1
  double cohesion_factor = 1.0;  ///< of the material's cohesion, >= 0
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
};

enum class Shape { kBall, kBox, kHalfSpace };
enum class Motion { kStatic, kDriven, kFree };
std::string_view to_string(Shape shape);
std::string_view to_string(Motion motion);

/// A rigid body; in two dimensions a disc, a rectangle, a half plane, per metre of thickness.
struct Body {
  Shape shape = Shape::kBall;
  Motion motion = Motion::kStatic;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();      ///< a point of the surface: half space
  double radius_m = 0.0;                                   ///< ball
  Eigen::Vector3d half_size_m = Eigen::Vector3d::Zero();   ///< box
  Eigen::Vector3d normal = Eigen::Vector3d::UnitY();       ///< half space: out of the body
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  ///< rotation vector; 2D: about z
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Vector3d angular_velocity_rad_s = Eigen::Vector3d::Zero();
  double density_kg_m3 = 0.0;  ///< > 0 where motion is free
  double friction = 0.0;       ///< against the material and the walls, >= 0
};

/// A simulation as it is written in a scene file (TOML, SI units in the key names).
/// Places, sizes and normals have as many entries there as the grid has dimensions; gravity,
/// velocities and rotations have three, and in two dimensions stay in the plane. Gravity is 9.81
/// m/s2 along the last axis unless the file says otherwise.
struct Scene : engine::SceneHeader {
  Grid grid;
  double cfl = 0.5;  ///< cells that a particle may cross in a step, 0 < cfl <= 1
  Material material;
  std::array<Wall, 6> walls;  ///< axis 0 low, axis 0 high, axis 1 low, ...; see face_name()
  std::vector<Barrier> barriers;
  std::vector<Block> blocks;
  std::vector<Body> bodies;

  const Wall& wall(int axis, bool high) const {
    return walls[static_cast<std::size_t>(2 * axis + (high ? 1 : 0))];
  }
};

/// Reads a scene. `subject` is what errors call it: the file's name.
/// Errors: InputError with line, key, found and expected; an unknown key comes with a suggestion.
/// A scene that parses can be simulated: barriers, blocks and bodies are checked against the grid.
Scene parse_scene(std::string_view text, std::string_view subject);

/// A built-in scene by its name, or a scene file by its path.
Scene load_scene(const std::string& name_or_path);

/// The files of mpm/scenes, in alphabetical order.
std::span<const engine::BuiltinScene> builtin_scenes();

/// The full scene with every default, as a scene file; parse_scene() reads the same scene back.
std::string to_toml(const Scene& scene);

}  // namespace conebench::mpm
