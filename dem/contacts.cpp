#include "dem/contacts.h"

#include <algorithm>
#include <utility>

namespace conebench::dem {
namespace {

// Increasing in the order of the list: planes come after all bodies.
std::pair<int, int> key(const Contact& contact) {
  constexpr int kFirstPlane = 1 << 30;
  return {contact.body, contact.with_plane() ? kFirstPlane + contact.plane() : contact.other};
}

double smaller_radius(const Spheres& spheres, const Contact& contact) {
  const double radius = spheres.radius[static_cast<std::size_t>(contact.body)];
  if (contact.with_plane()) return radius;
  return std::min(radius, spheres.radius[static_cast<std::size_t>(contact.other)]);
}

}  // namespace

Eigen::Matrix3d frame_around(const Eigen::Vector3d& normal) {
  int axis = 0;
  normal.cwiseAbs().minCoeff(&axis);
  Eigen::Matrix3d frame;
  frame.col(0) = normal;
  frame.col(1) = Eigen::Vector3d::Unit(axis).cross(normal).normalized();
  frame.col(2) = normal.cross(frame.col(1));
  return frame;
}

Eigen::Vector3d relative_velocity(const Spheres& spheres, const Contact& contact) {
  const auto a = static_cast<std::size_t>(contact.body);
  // From the centre of `body` to its surface: -R n.
  Eigen::Vector3d u =
      spheres.velocity[a] - spheres.radius[a] * spheres.angular_velocity[a].cross(contact.normal());
  if (contact.with_plane()) return u;
  const auto b = static_cast<std::size_t>(contact.other);
  u -=
      spheres.velocity[b] + spheres.radius[b] * spheres.angular_velocity[b].cross(contact.normal());
  return u;
}

ContactList::ContactList(const Scene& scene)
    : skin_m_(scene.skin_m), reach_m_(scene.skin_m), material_count_(scene.materials.size()) {
  law_table_.assign(material_count_ * material_count_, -1);
  for (std::size_t i = 0; i < material_count_; ++i) {
    for (std::size_t j = i; j < material_count_; ++j) {
      const auto law = law_between(scene, scene.materials[i].name, scene.materials[j].name);
      if (!law) continue;
      const int index = static_cast<int>(laws_.size());
      law_table_[i * material_count_ + j] = law_table_[j * material_count_ + i] = index;
      laws_.push_back(*law);
      reach_m_ = std::max(reach_m_, law->rupture_distance_m);
    }
  }
  for (const Plane& plane : scene.planes) {
    plane_materials_.push_back(material_index(scene, plane.material));
  }
}

int ContactList::law_index(int first_material, int second_material) const {
  return law_table_[static_cast<std::size_t>(first_material) * material_count_ +
                    static_cast<std::size_t>(second_material)];
}

void ContactList::add_pairs(const Spheres& spheres) {
  cells_.find_pairs(spheres.position, spheres.radius, reach_m_, pairs_);
  for (const auto& [first, second] : pairs_) {
    const auto a = static_cast<std::size_t>(first);
    const auto b = static_cast<std::size_t>(second);
    if (spheres.first_dof[a] < 0 && spheres.first_dof[b] < 0) continue;
    const Eigen::Vector3d offset = spheres.position[a] - spheres.position[b];
    const double distance = offset.norm();
    const Eigen::Vector3d normal =
        distance > 0.0 ? Eigen::Vector3d(offset / distance) : Eigen::Vector3d::UnitZ();
    Contact contact;
    contact.body = first;
    contact.other = second;
    contact.law = law_index(spheres.material[a], spheres.material[b]);
    contact.gap = distance - spheres.radius[a] - spheres.radius[b];
    contact.point = spheres.position[a] - (spheres.radius[a] + 0.5 * contact.gap) * normal;
    contact.frame = frame_around(normal);
    contacts_.push_back(contact);
  }
}

void ContactList::add_planes(const Scene& scene, const Spheres& spheres, double time_s) {
  for (std::size_t p = 0; p < scene.planes.size(); ++p) {
    const Plane& plane = scene.planes[p];
    if (time_s >= plane.until_s) continue;
    const Eigen::Matrix3d frame = frame_around(plane.normal);
    for (int i = 0; i < spheres.count(); ++i) {
      const auto a = static_cast<std::size_t>(i);
      if (spheres.first_dof[a] < 0) continue;
      Contact contact;
      contact.gap = plane.normal.dot(spheres.position[a] - plane.point_m) - spheres.radius[a];
      if (contact.gap >= reach_m_) continue;
      contact.body = i;
      contact.other = -1 - static_cast<int>(p);
      contact.law = law_index(spheres.material[a], plane_materials_[p]);
      contact.point = spheres.position[a] - (spheres.radius[a] + 0.5 * contact.gap) * plane.normal;
      contact.frame = frame;
      contacts_.push_back(contact);
    }
  }
}

// Bonds and reactions of the contacts that were there before; both lists are sorted.
void ContactList::inherit(const Spheres& spheres) {
  auto old = previous_.begin();
  for (Contact& contact : contacts_) {
    while (old != previous_.end() && key(*old) < key(contact)) ++old;
    if (old != previous_.end() && key(*old) == key(contact)) {
      contact.bonded = old->bonded;
      contact.reaction = old->reaction;
    }
    const PairLaw& law = law_of(contact);
    if (law.tensile_force_N == 0.0) continue;
    if (contact.gap <= kBondingGap * smaller_radius(spheres, contact)) contact.bonded = true;
    if (contact.gap > law.rupture_distance_m) contact.bonded = false;
  }
  std::erase_if(contacts_,
                [&](const Contact& contact) { return contact.gap >= skin_m_ && !contact.bonded; });
}

void ContactList::update(const Scene& scene, const Spheres& spheres, double time_s) {
  std::swap(contacts_, previous_);
  contacts_.clear();
  add_pairs(spheres);
  add_planes(scene, spheres, time_s);
  std::sort(contacts_.begin(), contacts_.end(),
            [](const Contact& a, const Contact& b) { return key(a) < key(b); });
  inherit(spheres);
}

}  // namespace conebench::dem
