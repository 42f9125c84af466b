#include "dem/placement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "dem/overlaps.h"
#include "dem/scene_shapes.h"
#include "problems/error.h"

namespace conebench::dem {
namespace {

using problems::require;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

// Collects what generators make.
class Builder : public Nursery {
 public:
  Builder(const Scene& scene, std::string_view subject, Placement& out)
      : scene_(scene),
        subject_(subject),
        out_(out),
        engine_(static_cast<std::uint64_t>(scene.seed)) {
    for (const SceneShape& shape : scene.shapes) this->shape(shape.shape());
  }

  int dimension() const override { return scene_.dimension; }
  std::string_view subject() const override { return subject_; }

  // std::uniform_real_distribution promises less.
  double random() override { return static_cast<double>(engine_() >> 11) * 0x1p-53; }

  int shape(const std::string& name) override {
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i) {
      if (scene_.shapes[i].name == name) return static_cast<int>(i);
    }
    throw problems::InputError(subject_, fmt::format("no shape \"{}\"", name));
  }

  int shape(const Shape& made) override {
    out_.solids.push_back(make_solid(made, out_.pieces));
    massless_.push_back(made.has_mesh());
    return static_cast<int>(out_.solids.size()) - 1;
  }

  const Solid& solid(int solid) const override { return out_.solids[at(solid)]; }

  void add(const Seedling& seedling) override {
    Bodies& bodies = out_.bodies;
    const int index = static_cast<int>(bodies.position.size());
    const bool ball = seedling.solid < 0;
    const bool free = !seedling.fixed && seedling.motion.empty();
    require(!free || ball || !massless_[at(seedling.solid)], subject_, "body ", index,
            " has a mesh, which has no mass, expected fixed = true or a motion");
    const Pose pose = ball ? seedling.pose : seedling.pose * from_shape(seedling).inverse();
    push(pose, seedling.velocity_m_s, seedling.angular_velocity_rad_s, seedling.material, free);
    bodies.radius.push_back(ball ? seedling.radius_m : -1.0);
    bodies.solid.push_back(ball ? Bodies::kBall : seedling.solid);
    if (free) give_mass(seedling, index);
    if (!seedling.motion.empty()) {
      out_.driven.push_back({index, motion_index(scene_, seedling.motion), pose});
    }
  }

  void add(const Plane& plane) {
    const int index = static_cast<int>(out_.bodies.position.size());
    const Pose pose{plane.point_m,
                    Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), plane.normal)};
    push(pose, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), plane.material, false);
    out_.bodies.radius.push_back(-1.0);
    out_.bodies.solid.push_back(Bodies::kPlane);
    ++out_.bodies.planes;
    out_.planes.push_back(plane);
    if (!plane.motion.empty()) {
      out_.driven.push_back({index, motion_index(scene_, plane.motion), pose});
    }
  }

 private:
  const Pose& from_shape(const Seedling& seedling) const {
    return out_.solids[at(seedling.solid)].from_shape;
  }

  void push(const Pose& pose, const Eigen::Vector3d& velocity,
            const Eigen::Vector3d& angular_velocity, const std::string& material, bool free) {
    Bodies& bodies = out_.bodies;
    bodies.position.push_back(pose.position);
    bodies.orientation.push_back(pose.orientation);
    bodies.velocity.push_back(velocity);
    bodies.angular_velocity.push_back(angular_velocity);
    bodies.material.push_back(material_index(scene_, material));
    bodies.mass.push_back(0.0);
    bodies.moments.push_back(Eigen::Vector3d::Zero());
    bodies.first_dof.push_back(free ? bodies.dofs : -1);
    if (free) bodies.dofs += scene_.dimension == 2 ? 3 : 6;
  }

  void give_mass(const Seedling& seedling, int index) {
    Bodies& bodies = out_.bodies;
    const double density = scene_.materials[at(bodies.material[at(index)])].density_kg_m3;
    if (seedling.solid < 0) {
      const double R = seedling.radius_m;
      const double mass = 4.0 / 3.0 * std::numbers::pi * R * R * R * density;
      bodies.mass[at(index)] = mass;
      bodies.moments[at(index)].setConstant(0.4 * mass * R * R);
      return;
    }
    const Solid& solid = out_.solids[at(seedling.solid)];
    bodies.mass[at(index)] = density * solid.volume_m3;
    bodies.moments[at(index)] = density * solid.moments_m5;
  }

  const Scene& scene_;
  std::string subject_;
  Placement& out_;
  std::mt19937_64 engine_;
  std::vector<bool> massless_;  // of each solid
};

void add_body(const Body& body, Nursery& nursery) {
  Seedling seedling;
  seedling.pose = pose_of(body.position_m, body.rotation_rad);
  seedling.radius_m = body.radius_m;
  if (!body.shape.empty()) seedling.solid = nursery.shape(body.shape);
  seedling.material = body.material;
  seedling.velocity_m_s = body.velocity_m_s;
  seedling.angular_velocity_rad_s = body.angular_velocity_rad_s;
  seedling.fixed = body.fixed;
  seedling.motion = body.motion;
  nursery.add(seedling);
}

void add_container(const Container& container, Builder& builder) {
  for (int axis = 0; axis < 3; ++axis) {
    if (axis == 1 && builder.dimension() == 2) continue;
    for (const bool upper : {false, true}) {
      const std::string side = fmt::format("{}{}", upper ? '+' : '-', "xyz"[axis]);
      if (std::find(container.open.begin(), container.open.end(), side) != container.open.end()) {
        continue;
      }
      Plane plane;
      plane.point_m = upper ? container.high_m : container.low_m;
      plane.normal = (upper ? -1.0 : 1.0) * Eigen::Vector3d::Unit(axis);
      plane.material = container.material;
      plane.until_s = container.until_s;
      builder.add(plane);
    }
  }
}

template <class Items>
void place_all(const Items& items, Nursery& nursery) {
  for (const auto& item : items) place(item, nursery);
}

// Every two materials that can meet have a law.
void check_laws(const Scene& scene, const Bodies& bodies, std::string_view subject) {
  std::vector<bool> met(scene.materials.size(), false), free(met);
  for (std::size_t i = 0; i < bodies.material.size(); ++i) {
    met[at(bodies.material[i])] = true;
    if (bodies.first_dof[i] >= 0) free[at(bodies.material[i])] = true;
  }
  for (std::size_t a = 0; a < met.size(); ++a) {
    for (std::size_t b = 0; b < met.size(); ++b) {
      if (!free[a] || !met[b]) continue;
      const std::string &first = scene.materials[a].name, &second = scene.materials[b].name;
      require(law_between(scene, first, second).has_value(), subject, "pairs: no law between \"",
              first, "\" and \"", second, "\", expected a [[pairs]] or [default_pair] for them");
    }
  }
}

}  // namespace

Placement place_bodies(const Scene& scene, std::string_view subject) {
  Placement out;
  Builder builder(scene, subject, out);
  for (const Body& body : scene.bodies) add_body(body, builder);
  place_all(scene.columns, builder);
  place_all(scene.stacks, builder);
  place_all(scene.beds, builder);
  place_all(scene.lattices, builder);
  place_all(scene.depositions, builder);
  place_all(scene.walls, builder);
  place_all(scene.arches, builder);
  place_all(scene.towers, builder);
  place_all(scene.clumps, builder);
  place_all(scene.hoppers, builder);
  place_all(scene.drums, builder);
  for (const Plane& plane : scene.planes) builder.add(plane);
  for (const Container& container : scene.containers) add_container(container, builder);
  require(out.bodies.dofs > 0, subject, "no body can move, expected at least one");
  check_laws(scene, out.bodies, subject);
  if (scene.resolve) resolve_overlaps(scene.dimension, subject, out);
  refuse_overlaps(scene.dimension, subject, out);
  refuse_long_step(scene, subject, out);
  return out;
}

void drive(const Scene& scene, const Placement& placement, double time_s, Bodies& bodies) {
  for (const Driven& driven : placement.driven) {
    const Motion& motion = scene.motions[at(driven.motion)];
    const Pose pose = motion.displacement(time_s) * driven.rest;
    const Twist twist = mean_twist(motion, time_s, scene.step_s, pose.position);
    bodies.position[at(driven.body)] = pose.position;
    bodies.orientation[at(driven.body)] = pose.orientation;
    bodies.velocity[at(driven.body)] = twist.velocity_m_s;
    bodies.angular_velocity[at(driven.body)] = twist.rate_rad_s;
  }
}

}  // namespace conebench::dem
