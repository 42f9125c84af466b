#pragma once

#include <Eigen/Core>
#include <vector>

#include "dem/broad_phase.h"
#include "dem/scene.h"
#include "dem/spheres.h"

namespace conebench::dem {

/// Two bodies, or a body and a wall, that touch or are close to it.
///
/// The normal points towards `body`, away from `other`: with u the velocity of `body` relative to
/// `other` at the contact, u . normal > 0 opens it, and a positive normal reaction pushes `body`
/// along the normal.
struct Contact {
  int body = 0;
  int other = 0;  ///< > body: a body; < 0: plane -1 - other
  int law = 0;    ///< index in ContactList::laws()
  bool bonded = false;
  double gap = 0.0;       ///< < 0: overlap [m]
  Eigen::Vector3d point;  ///< in the middle of the gap [m]
  Eigen::Matrix3d frame;  ///< columns: normal, first and second tangent
  Eigen::Vector3d reaction = Eigen::Vector3d::Zero();  ///< last impulse on `body`, world [N s]

  bool with_plane() const { return other < 0; }
  int plane() const { return -1 - other; }
  auto normal() const { return frame.col(0); }
};

/// The velocity of `body` relative to `other` at the contact, in the world frame [m/s].
Eigen::Vector3d relative_velocity(const Spheres& spheres, const Contact& contact);

/// A right-handed frame whose first column is `normal` (unit length).
Eigen::Matrix3d frame_around(const Eigen::Vector3d& normal);

/// The contacts of a scene, kept from step to step.
///
/// A contact is listed while its gap is below the skin; a bonded one until its law's rupture
/// distance. It is the same contact as long as its two partners stay listed: it then keeps its
/// bond and its last reaction.
class ContactList {
 public:
  /// A bond forms when two surfaces are closer than this share of the (smaller) radius.
  static constexpr double kBondingGap = 1e-9;

  explicit ContactList(const Scene& scene);

  /// Lists the contacts at the present positions, forms bonds where surfaces touch and breaks
  /// those beyond their rupture distance. Planes with until_s <= time_s are gone.
  /// Order: by body, then by other body, then planes. Cost as CellList::find_pairs.
  void update(const Scene& scene, const Spheres& spheres, double time_s);

  std::vector<Contact>& contacts() { return contacts_; }
  const std::vector<Contact>& contacts() const { return contacts_; }
  const std::vector<PairLaw>& laws() const { return laws_; }
  const PairLaw& law_of(const Contact& contact) const {
    return laws_[static_cast<std::size_t>(contact.law)];
  }

 private:
  int law_index(int first_material, int second_material) const;
  void add_pairs(const Spheres& spheres);
  void add_planes(const Scene& scene, const Spheres& spheres, double time_s);
  void inherit(const Spheres& spheres);

  double skin_m_ = 0.0;
  double reach_m_ = 0.0;  // largest gap at which a contact can be listed
  std::size_t material_count_ = 0;
  std::vector<PairLaw> laws_;
  std::vector<int> law_table_;        // material_count_ squared; -1: these never meet
  std::vector<int> plane_materials_;  // one a plane
  CellList cells_;
  std::vector<BodyPair> pairs_;
  std::vector<Contact> contacts_, previous_;
};

}  // namespace conebench::dem
