#pragma once

#include <vector>

#include "dem/contacts.h"
#include "problems/problem.h"

namespace conebench::dem {

/// The cone problem of one Moreau-Jean step, as arrays.
///
///   M = blockdiag(m I3, J),  f = M v_minus + h f_ext,  w = a_n e_n for every contact that enters:
///   e > 0   enters when gap + h u_n_minus / 2 <= 0;  a_n = e min(u_n_minus, 0)
///   e = 0   enters;                                  a_n = max(gap, 0) / h
///   bonded  enters; a_n = max(gap, 0) / h while gap > 0, else as above;  kappa = h tensile_force
///
/// Dofs: six a free sphere (v, then omega, world frame), in the order of the spheres. Rows: normal,
/// first tangent, second tangent; a frictionless contact has the normal alone.
struct Assembly {
  problems::PrimalData data;
  std::vector<problems::Cone> cones;
  std::vector<int> entered;  ///< of each cone: its contact's index in the list
  Eigen::VectorXd guess;     ///< r' = r + kappa e_n, from each contact's last reaction [N s]
};

/// Cost: linear in spheres and contacts; H is written row by row in its final place.
Assembly assemble(const Scene& scene, const Spheres& spheres, const ContactList& list);

}  // namespace conebench::dem
