#include "dem/scene_check.h"

#include <fmt/format.h>

#include <cmath>
#include <set>

#include "problems/error.h"
#include "problems/suggest.h"

namespace conebench::dem {
namespace {

using problems::InputError;
using problems::require;

// The names of one kind of thing, "material" and so on; each may be there once.
class Names {
 public:
  template <class Items>
  Names(const Items& items, std::string_view kind, std::string_view subject)
      : kind_(kind), subject_(subject) {
    for (const auto& item : items) {
      require(names_.insert(item.name).second, subject, kind, "s: \"", item.name,
              "\" is there twice");
    }
  }

  void need(const std::string& name, std::string_view where) const {
    if (names_.contains(name)) return;
    const std::vector<std::string> candidates(names_.begin(), names_.end());
    throw InputError(subject_, fmt::format("{}: no {} \"{}\"{}", where, kind_, name,
                                           problems::suggestion(name, candidates)));
  }

 private:
  std::string_view kind_, subject_;
  std::set<std::string> names_;
};

void check_materials(const Scene& scene, std::string_view subject) {
  const Names known(scene.materials, "material", subject);
  for (const auto& pair : scene.pairs) {
    known.need(pair.first, "pairs");
    known.need(pair.second, "pairs");
  }
  const auto need_all = [&](const auto& items, std::string_view where) {
    for (const auto& item : items) known.need(item.material, where);
  };
  need_all(scene.planes, "planes");
  need_all(scene.containers, "containers");
  need_all(scene.bodies, "bodies");
  need_all(scene.columns, "columns");
  need_all(scene.stacks, "stacks");
  need_all(scene.beds, "beds");
  need_all(scene.lattices, "lattices");
  need_all(scene.depositions, "depositions");
  need_all(scene.walls, "walls");
  need_all(scene.arches, "arches");
  need_all(scene.towers, "towers");
  need_all(scene.clumps, "clumps");
  need_all(scene.hoppers, "hoppers");
  need_all(scene.drums, "drums");
}

void check_motions(const Scene& scene, std::string_view subject) {
  const Names known(scene.motions, "motion", subject);
  for (const auto& plane : scene.planes) {
    if (!plane.motion.empty()) known.need(plane.motion, "planes");
  }
  for (const auto& body : scene.bodies) {
    if (!body.motion.empty()) known.need(body.motion, "bodies");
  }
  for (const auto& hopper : scene.hoppers) {
    if (!hopper.lid_motion.empty()) known.need(hopper.lid_motion, "hoppers: lid_motion");
  }
  for (const auto& drum : scene.drums) {
    if (!drum.motion.empty()) known.need(drum.motion, "drums");
  }
}

void check_shapes(const Scene& scene, std::string_view subject) {
  const Names known(scene.shapes, "shape", subject);
  for (const auto& body : scene.bodies) {
    if (!body.shape.empty()) known.need(body.shape, "bodies");
  }
  for (const auto& lattice : scene.lattices) {
    if (!lattice.shape.empty()) known.need(lattice.shape, "lattices");
  }
  for (const auto& deposition : scene.depositions) {
    for (const std::string& shape : deposition.shapes) known.need(shape, "depositions");
  }
}

void check_plane_of_motion(const Scene& scene, std::string_view subject) {
  const auto flat = [&](const Eigen::Vector3d& x, std::string_view key) {
    require(x.y() == 0.0, subject, key, ": found y = ", x.y(),
            ", expected 0 in a scene of dimension 2, whose plane is y = 0");
  };
  const auto upright = [&](const Eigen::Vector3d& x, std::string_view key) {
    require(x.x() == 0.0 && x.z() == 0.0, subject, key,
            ": expected a turn about y alone in a scene of dimension 2");
  };
  flat(scene.gravity_m_s2, "gravity_m_s2");
  for (const Plane& plane : scene.planes) flat(plane.normal, "planes: normal");
  for (const Body& body : scene.bodies) {
    flat(body.position_m, "bodies: position_m");
    flat(body.velocity_m_s, "bodies: velocity_m_s");
    upright(body.rotation_rad, "bodies: rotation_rad");
    upright(body.angular_velocity_rad_s, "bodies: angular_velocity_rad_s");
  }
  for (const Column& column : scene.columns) flat(column.base_m, "columns: base_m");
  for (const Stack& stack : scene.stacks) flat(stack.base_m, "stacks: base_m");
  for (const Bed& bed : scene.beds) flat(bed.centre_m, "beds: centre_m");
  for (const Lattice& lattice : scene.lattices) flat(lattice.base_m, "lattices: base_m");
  for (const Deposition& deposition : scene.depositions) {
    flat(deposition.velocity_m_s, "depositions: velocity_m_s");
  }
  for (const Wall& wall : scene.walls) flat(wall.base_m, "walls: base_m");
  for (const Arch& arch : scene.arches) flat(arch.base_m, "arches: base_m");
  for (const Tower& tower : scene.towers) flat(tower.base_m, "towers: base_m");
  for (const Clump& clump : scene.clumps) {
    flat(clump.centre_m, "clumps: centre_m");
    flat(clump.velocity_m_s, "clumps: velocity_m_s");
  }
  for (const Hopper& hopper : scene.hoppers) flat(hopper.base_m, "hoppers: base_m");
  for (const Drum& drum : scene.drums) flat(drum.centre_m, "drums: centre_m");
}

}  // namespace

void check_scene(const Scene& scene, std::string_view subject) {
  check_materials(scene, subject);
  check_motions(scene, subject);
  check_shapes(scene, subject);
  if (scene.dimension == 2) check_plane_of_motion(scene, subject);
}

}  // namespace conebench::dem
