#pragma once

#include <array>
#include <vector>

#include "mpm/cohesion_law.h"
#include "mpm/nodes.h"
#include "mpm/rigid_body.h"
#include "problems/problem.h"

namespace conebench::mpm {

/// Where a Coulomb cone sits that is not a stress node: at a frictional wall, at a body's surface,
/// or where a body touches a wall. Its rate is weight x (velocity of `node`, or of the body's
/// point, relative to `body`, or to the wall), in the frame; so r is an impulse per weight.
struct Interface {
  Eigen::Vector3d point;  ///< [m]
  Eigen::Matrix3d frame;  ///< columns: normal (off `body`, off the wall), tangents
  int node = -1;          ///< place in Nodes; -1: the body itself meets a wall
  int body = -1;          ///< -1: a wall
  double weight = 0.0;    ///< area x volume fraction [m2, per metre in 2D]
  double friction = 0.0;
  double gap_m = 0.0;  ///< may close by this much
};

/// The cone problem of one step, as arrays:
///
///   dofs   the free components of the velocities of active nodes, node by node, then 3 (2D) or
///          6 (3D) of every free body: v, omega
///   M      rho Phi_i (with viscosity_in_mass + h x viscous form), bodies' inertia
///   cones  one stress cone a node, d = 3 or 6; then interfaces, d = 2 or 3
///   H      rbar . (B v) = sum_p V_p r(x_p) : D(v)(x_p) on the stress rows
///
/// Rows of shear stress at slip walls are zero. Components held by walls are eliminated.
struct Assembly {
  problems::PrimalData data;            ///< w is 0 on the stress rows: the law sets it
  std::vector<problems::Cone> cones;    ///< kappa is 0 on the stress cones: likewise
  std::vector<Interface> interfaces;    ///< of the cones from nodes.count() on
  std::vector<std::array<int, 3>> dof;  ///< of each node and axis; -1: held
  std::vector<int> body_dof;            ///< first one of each body; -1: not free
  Eigen::VectorXd free_velocity;        ///< M^-1 f, one entry a dof
  Eigen::VectorXd guess;                ///< unshifted r from the particles' stress
  LawInput law;
};

/// `h` is the step. Cost: linear in the active nodes; H is written row by row in its final place.
Assembly assemble(const Scene& scene, const Particles& particles, const Nodes& nodes,
                  const std::vector<RigidBody>& bodies, double time_s, double h);

/// The velocity of every active node for the dofs' velocities. Held components are 0.
std::vector<Eigen::Vector3d> node_velocities(const Assembly& assembly, const Eigen::VectorXd& v);

}  // namespace conebench::mpm
