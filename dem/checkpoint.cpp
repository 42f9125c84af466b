#include "problems/engine/checkpoint.h"
#include "dem/simulation.h"

namespace conebench::dem {
namespace {

using engine::bytes_of;
using engine::read_bytes;
using nlohmann::json;

engine::CheckpointKind kind_of(const Scene& scene) {
  return {"conebench-dem-checkpoint", 1, to_toml(scene), scene.name};
}

// Calls f(name, array) for every array of the bodies that changes.
template <class Owner, class F>
void for_each_array(Owner& bodies, const F& f) {
  f("position", bodies.position);
  f("velocity", bodies.velocity);
  f("angular_velocity", bodies.angular_velocity);
  f("orientation", bodies.orientation);
}

json contacts_to_json(const std::vector<Contact>& contacts) {
  std::vector<int> pairs;
  std::vector<double> numbers;
  for (const Contact& contact : contacts) {
    pairs.insert(pairs.end(), {contact.body, contact.other, contact.law, contact.bonded});
    numbers.push_back(contact.gap);
    for (const Eigen::Vector3d* x : {&contact.point, &contact.normal, &contact.reaction}) {
      numbers.insert(numbers.end(), x->begin(), x->end());
    }
  }
  return {{"count", contacts.size()}, {"pairs", bytes_of(pairs)}, {"numbers", bytes_of(numbers)}};
}

std::vector<Contact> contacts_from_json(const json& in, const Bodies& bodies, std::size_t laws) {
  const std::size_t count = in.at("count");
  std::vector<int> pairs;
  std::vector<double> numbers;
  read_bytes(in.at("pairs"), 4 * count, pairs);
  read_bytes(in.at("numbers"), 10 * count, numbers);
  const int last = static_cast<int>(bodies.position.size());
  std::vector<Contact> contacts(count);
  for (std::size_t i = 0; i < count; ++i) {
    Contact& contact = contacts[i];
    contact.body = pairs[4 * i];
    contact.other = pairs[4 * i + 1];
    contact.law = pairs[4 * i + 2];
    contact.bonded = pairs[4 * i + 3] != 0;
    if (contact.body < 0 || contact.other <= contact.body || contact.other >= last ||
        contact.law < 0 || static_cast<std::size_t>(contact.law) >= laws) {
      throw std::out_of_range("a contact of bodies or laws that are not there");
    }
    const double* x = numbers.data() + 10 * i;
    contact.gap = x[0];
    contact.point = Eigen::Map<const Eigen::Vector3d>(x + 1);
    contact.normal = Eigen::Map<const Eigen::Vector3d>(x + 4);
    contact.reaction = Eigen::Map<const Eigen::Vector3d>(x + 7);
  }
  return contacts;
}

// Counts, seconds and energies, in one fixed order.
template <class Totals, class Ledger, class F>
void for_each_total(Totals& s, Ledger& e, const F& f) {
  f("steps", s.steps);
  f("free_steps", s.free_steps);
  f("unconverged_steps", s.unconverged_steps);
  f("iterations", s.iterations);
  f("most_cones", s.most_cones);
  f("last_cones", s.last_cones);
  f("last_bonds", s.last_bonds);
  f("deepest_overlap_m", s.deepest_overlap_m);
  f("contact_s", s.contact_s);
  f("assembly_s", s.assembly_s);
  f("solve_s", s.solve_s);
  f("engine_s", s.engine_s);
  f("kinetic_J", e.kinetic_J);
  f("potential_J", e.potential_J);
  f("initial_J", e.initial_J);
  f("bond_J", e.bond_J);
  f("friction_J", e.friction_J);
  f("impact_J", e.impact_J);
  f("driven_J", e.driven_J);
  f("gyro_J", e.gyro_J);
  f("scheme_J", e.scheme_J);
}

}  // namespace

void Simulation::save(const std::filesystem::path& path) const {
  json out;
  for_each_array(bodies(), [&](const char* name, const auto& values) {
    out["bodies"][name] = bytes_of(values);
  });
  out["contacts"] = contacts_to_json(contacts_.contacts());
  for_each_total(summary_, energy_,
                 [&](const char* name, const auto& value) { out["totals"][name] = value; });
  engine::write_checkpoint(path, kind_of(scene_), std::move(out));
}

void Simulation::restart(const std::filesystem::path& path) {
  engine::read_checkpoint(path, kind_of(scene_), [this](const json& in) {
    Bodies bodies = placement_.bodies;
    const std::size_t count = bodies.position.size();
    for_each_array(bodies, [&](const char* name, auto& values) {
      read_bytes(in.at("bodies").at(name), count, values);
    });
    auto contacts = contacts_from_json(in.at("contacts"), bodies, contacts_.laws().size());
    Summary summary;
    EnergyLedger energy;
    for_each_total(summary, energy,
                   [&](const char* name, auto& v) { in.at("totals").at(name).get_to(v); });
    placement_.bodies = std::move(bodies);
    contacts_.set_contacts(std::move(contacts));
    summary_ = summary;
    energy_ = energy;
  });
}

}  // namespace conebench::dem
