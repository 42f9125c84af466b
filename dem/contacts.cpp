#include "dem/contacts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace conebench::dem {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::pair<int, int> key(const Contact& contact) { return {contact.body, contact.other}; }

Eigen::Vector3d arm(const Bodies& bodies, const Contact& contact, int body, double side) {
  // A ball's centre is on the line of the normal, whatever the rounding of the point.
  if (bodies.is_ball(body)) return -side * bodies.radius[at(body)] * contact.normal;
  return contact.point + side * 0.5 * contact.gap * contact.normal - bodies.position[at(body)];
}

Eigen::Vector3d velocity_at(const Bodies& bodies, int body, const Eigen::Vector3d& arm) {
  return bodies.velocity[at(body)] + bodies.angular_velocity[at(body)].cross(arm);
}

}  // namespace

Eigen::Matrix3d frame_of(const Contact& contact, int dimension) {
  Eigen::Matrix3d frame;
  frame.col(0) = contact.normal;
  if (dimension == 2) {
    frame.col(2) = Eigen::Vector3d::UnitY();
    frame.col(1) = Eigen::Vector3d::UnitY().cross(contact.normal);
    return frame;
  }
  int axis = 0;
  contact.normal.cwiseAbs().minCoeff(&axis);
  frame.col(1) = Eigen::Vector3d::Unit(axis).cross(contact.normal).normalized();
  frame.col(2) = contact.normal.cross(frame.col(1));
  return frame;
}

Eigen::Vector3d arm_of_body(const Bodies& bodies, const Contact& contact) {
  return arm(bodies, contact, contact.body, 1.0);
}

Eigen::Vector3d arm_of_other(const Bodies& bodies, const Contact& contact) {
  return arm(bodies, contact, contact.other, -1.0);
}

Eigen::Vector3d relative_velocity(const Bodies& bodies, const Contact& contact) {
  return velocity_at(bodies, contact.body, arm_of_body(bodies, contact)) -
         velocity_at(bodies, contact.other, arm_of_other(bodies, contact));
}

Eigen::Vector3d driven_velocity(const Bodies& bodies, const Contact& contact) {
  Eigen::Vector3d u = Eigen::Vector3d::Zero();
  if (!bodies.is_free(contact.body)) {
    u += velocity_at(bodies, contact.body, arm_of_body(bodies, contact));
  }
  if (!bodies.is_free(contact.other)) {
    u -= velocity_at(bodies, contact.other, arm_of_other(bodies, contact));
  }
  return u;
}

ContactList::ContactList(const Scene& scene, const Placement& placement)
    : skin_m_(scene.skin_m),
      reach_m_(scene.skin_m),
      material_count_(scene.materials.size()),
      neighbours_(placement, scene.dimension) {
  for (const Solid& solid : placement.solids) sizes_.push_back(solid.size_m);
  make_laws(scene);
}

void ContactList::make_laws(const Scene& scene) {
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
}

int ContactList::law_index(int first_material, int second_material) const {
  return law_table_[at(first_material) * material_count_ + at(second_material)];
}

double ContactList::size_of(const Bodies& bodies, int body) const {
  if (bodies.is_ball(body)) return bodies.radius[at(body)];
  if (bodies.is_plane(body)) return std::numeric_limits<double>::infinity();
  return sizes_[at(bodies.solid[at(body)])];
}

void ContactList::list(const Bodies& bodies) {
  contacts_.clear();
  contacts_.reserve(found_.size());
  for (const Near& near : found_) {
    Contact contact;
    contact.body = near.body;
    contact.other = near.other;
    contact.law = law_index(bodies.material[at(near.body)], bodies.material[at(near.other)]);
    contact.gap = near.touch.gap;
    contact.point = near.touch.point;
    contact.normal = near.touch.normal;
    contacts_.push_back(contact);
  }
}

// Bonds and reactions of the contacts of one pair from those it had before.
void ContactList::inherit_pair(Iterator begin, Iterator end, Iterator old_begin, Iterator old_end) {
  const bool bonded =
      std::any_of(old_begin, old_end, [](const Contact& old) { return old.bonded; });
  for (Iterator contact = begin; contact != end; ++contact) contact->bonded = bonded;
  // Each old reaction goes to one new contact, the nearest that has none yet.
  std::vector<bool> given(static_cast<std::size_t>(end - begin), false);
  for (Iterator old = old_begin; old != old_end; ++old) {
    double least = std::numeric_limits<double>::infinity();
    Iterator nearest = end;
    for (Iterator contact = begin; contact != end; ++contact) {
      const double distance = (contact->point - old->point).squaredNorm();
      if (given[static_cast<std::size_t>(contact - begin)] || distance >= least) continue;
      least = distance;
      nearest = contact;
    }
    if (nearest == end) return;
    given[static_cast<std::size_t>(nearest - begin)] = true;
    nearest->reaction = old->reaction;
  }
}

void ContactList::bond(const Bodies& bodies, double time_s, Contact& contact) const {
  const PairLaw& law = law_of(contact);
  const double size = std::min(size_of(bodies, contact.body), size_of(bodies, contact.other));
  if (contact.gap <= kBondingGap * size && forms_bonds(law, time_s)) contact.bonded = true;
  if (contact.gap > law.rupture_distance_m) contact.bonded = false;
}

// Both lists are sorted by pair.
void ContactList::inherit(const Bodies& bodies, double time_s) {
  const auto end_of_pair = [](Iterator i, Iterator end) {
    return std::find_if(i, end, [&](const Contact& contact) { return key(contact) != key(*i); });
  };
  auto old = previous_.begin();
  for (auto begin = contacts_.begin(); begin != contacts_.end();) {
    const auto end = end_of_pair(begin, contacts_.end());
    while (old != previous_.end() && key(*old) < key(*begin)) ++old;
    if (old != previous_.end() && key(*old) == key(*begin)) {
      const auto old_end = end_of_pair(old, previous_.end());
      if (end - begin == 1 && old_end - old == 1) {
        begin->bonded = old->bonded;
        begin->reaction = old->reaction;
      } else {
        inherit_pair(begin, end, old, old_end);
      }
      old = old_end;
    }
    begin = end;
  }
  for (Contact& contact : contacts_) bond(bodies, time_s, contact);
  std::erase_if(contacts_,
                [&](const Contact& contact) { return contact.gap >= skin_m_ && !contact.bonded; });
}

void ContactList::update(const Bodies& bodies, double time_s) {
  std::swap(contacts_, previous_);
  neighbours_.find(bodies, reach_m_, time_s, found_);
  list(bodies);
  inherit(bodies, time_s);
}

}  // namespace conebench::dem
