#pragma once

#include <Eigen/Core>
#include <vector>

#include "dem/neighbours.h"
#include "dem/scene.h"

namespace conebench::dem {

/// A point where two bodies, or a body and a plane, touch or are close to it.
///
/// The normal points towards `body`, away from `other`: with u the velocity of `body` relative to
/// `other` at the contact, u . normal > 0 opens it, and a positive normal reaction pushes `body`
/// along the normal.
struct Contact {
  int body = 0;
  int other = 0;  ///< > body
  int law = 0;    ///< index in ContactList::laws()
  bool bonded = false;
  double gap = 0.0;                                    ///< < 0: overlap [m]
  Eigen::Vector3d point;                               ///< in the middle of the gap [m]
  Eigen::Vector3d normal;                              ///< unit length
  Eigen::Vector3d reaction = Eigen::Vector3d::Zero();  ///< last impulse on `body`, world [N s]
};

/// The contact's frame: columns normal, first and second tangent, right-handed. In two dimensions
/// the second tangent is y.
Eigen::Matrix3d frame_of(const Contact& contact, int dimension);

/// From the centre of `body`, or of `other`, to where it is touched [m].
Eigen::Vector3d arm_of_body(const Bodies& bodies, const Contact& contact);
Eigen::Vector3d arm_of_other(const Bodies& bodies, const Contact& contact);

/// The velocity of `body` relative to `other` at the contact, in the world frame [m/s].
Eigen::Vector3d relative_velocity(const Bodies& bodies, const Contact& contact);

/// The part of it that is not for the solver to change: of bodies and planes that are not free.
Eigen::Vector3d driven_velocity(const Bodies& bodies, const Contact& contact);

/// The contacts of a scene, kept from step to step.
///
/// A contact is listed while its gap is below the skin; a bonded one until its law's rupture
/// distance. Two balls, or a ball and a plane, have one contact, which is the same as long as it is
/// listed: it keeps its bond and its last reaction. The points where other shapes touch come and
/// go: each takes the reaction of the nearest one of its pair in the last step, and bonds are the
/// pair's: where any of its points was bonded, all are that are within the rupture distance.
class ContactList {
 public:
  /// A bond forms when two surfaces are closer than this share of the smaller one's size.
  static constexpr double kBondingGap = 1e-9;

  ContactList(const Scene& scene, const Placement& placement);

  /// Lists the contacts at the present positions, forms bonds where surfaces touch (until the law's
  /// bonds_form_until_s) and breaks those beyond their rupture distance.
  /// Order: by body, then by other. Cost as Neighbours::find.
  void update(const Bodies& bodies, double time_s);

  /// Bonds a contact that carries a compressive reaction, where its law says so.
  void touch(Contact& contact, double time_s) const {
    if (forms_bonds(law_of(contact), time_s)) contact.bonded = true;
  }

  /// What update() starts from; for a restart.
  void set_contacts(std::vector<Contact> contacts) { contacts_ = std::move(contacts); }

  std::vector<Contact>& contacts() { return contacts_; }
  const std::vector<Contact>& contacts() const { return contacts_; }
  const std::vector<PairLaw>& laws() const { return laws_; }
  const PairLaw& law_of(const Contact& contact) const {
    return laws_[static_cast<std::size_t>(contact.law)];
  }

 private:
  using Iterator = std::vector<Contact>::iterator;

  static bool forms_bonds(const PairLaw& law, double time_s) {
    return law.tensile_force_N > 0.0 && time_s < law.bonds_form_until_s;
  }
  void make_laws(const Scene& scene);
  int law_index(int first_material, int second_material) const;
  double size_of(const Bodies& bodies, int body) const;
  void list(const Bodies& bodies);
  void inherit(const Bodies& bodies, double time_s);
  void inherit_pair(Iterator begin, Iterator end, Iterator old_begin, Iterator old_end);
  void bond(const Bodies& bodies, double time_s, Contact& contact) const;

  double skin_m_;
  double reach_m_;  // largest gap at which a contact can be listed
  std::size_t material_count_;
  std::vector<PairLaw> laws_;
  std::vector<int> law_table_;  // material_count_ squared; -1: these never meet
  std::vector<double> sizes_;   // of each solid
  Neighbours neighbours_;
  std::vector<Near> found_;
  std::vector<Contact> contacts_, previous_;
};

}  // namespace conebench::dem
