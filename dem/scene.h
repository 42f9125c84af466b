#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "dem/generators/arch.h"
#include "dem/generators/bed.h"
#include "dem/generators/clump.h"
#include "dem/generators/column.h"
#include "dem/generators/deposition.h"
#include "dem/generators/drum.h"
#include "dem/generators/hopper.h"
#include "dem/generators/lattice.h"
#include "dem/generators/stack.h"
#include "dem/generators/tower.h"
#include "dem/generators/wall.h"
#include "dem/motion.h"
#include "dem/shape.h"
#include "problems/engine/scene_file.h"

namespace conebench::dem {

struct Material {
  std::string name;
  double density_kg_m3 = 0.0;  ///< > 0
};

/// How the strength of a bond depends on how far it is open.
enum class Decay {
  kNone,    ///< whole until the rupture distance
  kLinear,  ///< falls to 0 at the rupture distance
};

/// What happens where two materials touch.
struct PairLaw {
  double friction = 0.0;         ///< Coulomb coefficient [-], >= 0; 0 makes a cone of dimension 1
  double restitution = 0.0;      ///< Newton's e [-], 0 <= e <= 1
  double tensile_force_N = 0.0;  ///< strength of a bond, >= 0, a contact point; needs friction > 0
  double rupture_distance_m = 0.0;  ///< gap at which a bond breaks, > 0 where there are bonds
  Decay decay = Decay::kNone;
  /// Bonds that break later than this are broken for good; infinity: contact forms them again.
  double bonds_form_until_s = std::numeric_limits<double>::infinity();

  /// Of a bond that is open by `gap_m`.
  double strength_N(double gap_m) const {
    if (decay == Decay::kNone) return tensile_force_N;
    return tensile_force_N * (1.0 - std::clamp(gap_m / rupture_distance_m, 0.0, 1.0));
  }
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
  std::string motion;                                        ///< that it is driven by; empty: none
};

/// Generator: the planes of a box that bodies are inside of.
struct Container {
  Eigen::Vector3d low_m = Eigen::Vector3d::Zero(), high_m = Eigen::Vector3d::Zero();
  std::vector<std::string> open;  ///< sides without a plane: "-x", "+x", "-y", "+y", "-z", "+z"
  std::string material;
  double until_s = std::numeric_limits<double>::infinity();
};

/// A part of a shape as a scene writes it.
struct ScenePart {
  Piece piece;
  Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  ///< rotation vector
  std::filesystem::path file;  ///< that a hull's points, or a mesh, were read from
};

/// A shape that bodies refer to by name.
struct SceneShape {
  std::string name;
  std::vector<ScenePart> parts;

  Shape shape() const;
};

/// A ball, or a body of a named shape.
struct Body {
  Eigen::Vector3d position_m =
      Eigen::Vector3d::Zero();  ///< of the ball's centre, or shape's origin
  Eigen::Vector3d rotation_rad = Eigen::Vector3d::Zero();  ///< rotation vector, of the shape
  std::string shape;                                       ///< empty: a ball
  double radius_m = 0.0;                                   ///< > 0, of a ball
  std::string material;
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();  ///< of the centre of mass
  Eigen::Vector3d angular_velocity_rad_s = Eigen::Vector3d::Zero();
  bool fixed = false;  ///< held in place: no degrees of freedom
  std::string motion;  ///< that it is driven by; empty: none
};

/// A simulation as it is written in a scene file (TOML, SI units in the key names).
struct Scene : engine::SceneHeader {
  /// 3, or 2: motion in the plane y = 0 only; bodies keep their volume and mass.
  int dimension = 3;
  double skin_m = 0.0;   ///< contacts with a smaller gap are looked at, > 0
  bool resolve = false;  ///< push overlapping bodies apart instead of refusing them
  std::vector<Material> materials;
  std::optional<PairLaw> default_pair;  ///< for materials that no pair names
  std::vector<Pair> pairs;
  std::vector<SceneShape> shapes;
  std::vector<Motion> motions;
  std::vector<Plane> planes;
  std::vector<Container> containers;
  std::vector<Body> bodies;
  std::vector<Column> columns;
  std::vector<Stack> stacks;
  std::vector<Bed> beds;
  std::vector<Lattice> lattices;
  std::vector<Deposition> depositions;
  std::vector<Wall> walls;
  std::vector<Arch> arches;
  std::vector<Tower> towers;
  std::vector<Clump> clumps;
  std::vector<Hopper> hoppers;
  std::vector<Drum> drums;
};

/// Index of a material, or of a motion. Throws InputError naming it.
int material_index(const Scene& scene, std::string_view name);
int motion_index(const Scene& scene, std::string_view name);

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
