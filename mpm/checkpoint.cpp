#include <algorithm>

#include "mpm/simulation.h"
#include "problems/engine/checkpoint.h"

namespace conebench::mpm {
namespace {

using engine::bytes_of;
using engine::read_bytes;
using nlohmann::json;

engine::CheckpointKind kind_of(const Scene& scene) {
  return {"conebench-mpm-checkpoint", 1, to_toml(scene), scene.name};
}

// Calls f(name, array) for every array of the particles.
template <class Owner, class F>
void for_each_array(Owner& particles, const F& f) {
  f("position", particles.position);
  f("velocity", particles.velocity);
  f("affine", particles.affine);
  f("volume", particles.volume);
  f("cohesion", particles.cohesion);
  f("inertial_number", particles.inertial_number);
  f("stress", particles.stress);
}

// What moves of the bodies: 13 numbers each.
std::vector<double> body_numbers(const std::vector<RigidBody>& bodies) {
  std::vector<double> out;
  for (const RigidBody& b : bodies) {
    for (const Eigen::Vector3d& x : {b.centre_m, b.velocity, b.angular_velocity}) {
      out.insert(out.end(), x.begin(), x.end());
    }
    out.insert(out.end(), b.orientation.coeffs().begin(), b.orientation.coeffs().end());
  }
  return out;
}

void set_bodies(const std::vector<double>& from, std::vector<RigidBody>& bodies) {
  const double* x = from.data();
  for (RigidBody& b : bodies) {
    for (Eigen::Vector3d* vector : {&b.centre_m, &b.velocity, &b.angular_velocity}) {
      *vector = Eigen::Map<const Eigen::Vector3d>(x);
      x += 3;
    }
    b.orientation.coeffs() = Eigen::Map<const Eigen::Vector4d>(x);
    x += 4;
  }
}

// Counts and seconds of a summary, in one fixed order.
template <class Totals, class F>
void for_each_total(Totals& s, const F& f) {
  f("steps", s.steps);
  f("repeated_steps", s.repeated_steps);
  f("unconverged_steps", s.unconverged_steps);
  f("solves", s.solves);
  f("cycles", s.cycles);
  f("capped", s.capped);
  f("iterations", s.iterations);
  f("last_cones", s.last_cones);
  f("most_cones", s.most_cones);
  f("left_particles", s.left_particles);
  f("left_volume_m3", s.left_volume_m3);
  f("transfer_s", s.transfer_s);
  f("assembly_s", s.assembly_s);
  f("solve_s", s.solve_s);
}

// The engine trusts both: a stencil needs its particle inside the grid.
void check_places(const Grid& grid, const Particles& particles, const std::vector<int>& index) {
  const int count = grid.finest().node_count();
  const auto on_grid = [&](int node) { return node >= 0 && node < count; };
  const auto inside = [&](const Eigen::Vector3d& x) { return grid.contains(x); };
  if (!std::all_of(index.begin(), index.end(), on_grid) ||
      !std::all_of(particles.position.begin(), particles.position.end(), inside)) {
    throw std::out_of_range("a particle or a node outside the grid");
  }
}

}  // namespace

void Simulation::save(const std::filesystem::path& path) const {
  json out = {{"time_s", time_s_}, {"count", particles_.count()}};
  for_each_array(particles_, [&](const char* name, const auto& values) {
    out["particles"][name] = bytes_of(values);
  });
  out["nodes"] = {{"index", last_index_},
                  {"stress", bytes_of(last_stress_)},
                  {"state", bytes_of(last_states_)}};
  out["bodies"] = bytes_of(body_numbers(bodies_));
  for_each_total(summary_,
                 [&](const char* name, const auto& value) { out["totals"][name] = value; });
  engine::write_checkpoint(path, kind_of(scene_), std::move(out));
}

void Simulation::restart(const std::filesystem::path& path) {
  engine::read_checkpoint(path, kind_of(scene_), [this](const json& in) {
    Particles particles;
    for_each_array(particles, [&](const char* name, auto& values) {
      read_bytes(in.at("particles").at(name), in.at("count"), values);
    });
    std::vector<int> index;
    std::vector<Particles::Stress> stress;
    std::vector<NodeState> states;
    in.at("nodes").at("index").get_to(index);
    read_bytes(in.at("nodes").at("stress"), index.size(), stress);
    read_bytes(in.at("nodes").at("state"), index.size(), states);
    check_places(scene_.grid, particles, index);
    std::vector<double> numbers;
    read_bytes(in.at("bodies"), 13 * bodies_.size(), numbers);
    Summary summary;
    for_each_total(summary, [&](const char* name, auto& v) { in.at("totals").at(name).get_to(v); });
    time_s_ = in.at("time_s");
    summary_ = summary;
    particles_ = std::move(particles);
    last_index_ = std::move(index);
    last_stress_ = std::move(stress);
    last_states_ = std::move(states);
    set_bodies(numbers, bodies_);
  });
}

}  // namespace conebench::mpm
