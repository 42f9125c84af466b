#pragma once

#include <vector>

#include "dem/contacts.h"
#include "problems/problem.h"

namespace conebench::dem {

/// The cone problem of one Moreau-Jean step, as arrays.
///
///   M = blockdiag(m I3, R J R^T),  f = M v_minus + h (f_ext, -omega x R J R^T omega),
///   w = H_D v_D + a_n e_n for every contact that enters, H_D v_D being the part of its velocity
///   that is driven:
///   e > 0   enters when gap + h u_n_minus / 2 <= 0;  a_n = e min(u_n_minus, 0)
///   e = 0   enters;                                  a_n = max(gap, 0) / h
///   bonded  enters; a_n = max(gap, 0) / h while gap > 0, else as above;  kappa = h x strength
///
/// Dofs: six a free body (v, then omega, world frame), in the order of the bodies; in two
/// dimensions three (v_x, v_z, omega_y). Rows: normal, first tangent, second tangent (not in two
/// dimensions); a frictionless contact has the normal alone.
struct Assembly {
  problems::PrimalData data;
  std::vector<problems::Cone> cones;
  std::vector<int> entered;  ///< of each cone: its contact's index in the list
  Eigen::VectorXd guess;     ///< r' = r + kappa e_n, from each contact's last reaction [N s]
};

/// Cost: linear in bodies and contacts; H is written row by row in its final place.
Assembly assemble(const Scene& scene, const Bodies& bodies, const ContactList& list);

/// Sets the velocities of the free bodies from `v`, one entry a dof.
void scatter_velocity(int dimension, const Eigen::VectorXd& v, Bodies& bodies);

}  // namespace conebench::dem
