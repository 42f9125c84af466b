#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "mpm/mesh.h"
#include "mpm/particles.h"
#include "mpm/rigid_body.h"
#include "mpm/scene.h"

namespace conebench::mpm {

/// What the particles say to the grid at the beginning of a step: its cells, the active nodes and
/// what they carry, one entry an active node in every array, in the order of the grid's numbering.
///
/// Active are the nodes of the particles' stencils, less those that they hardly reach (a particle
/// on a face between cells gives its far nodes no volume).
struct Nodes {
  /// A node holding less than this share of its own volume is left out.
  static constexpr double kLeastShare = 1e-9;

  Mesh mesh;
  std::vector<int> index;    ///< node of mesh.grid()
  std::vector<int> slot_of;  ///< of every node of mesh.grid(): its place in `index`, or -1
  Eigen::VectorXd solid;     ///< Phi_i = sum V_p N_i(x_p) [m3]
  Eigen::VectorXd volume;    ///< V_i, the integral of N_i over the grid [m3]
  Eigen::VectorXd covered;   ///< the part of it that bodies or barriers keep sand from [m3]
  Eigen::VectorXd cohesion;  ///< c_i, mean over the particles [Pa]
  Eigen::VectorXd friction;  ///< mu(I)_i [-]
  std::vector<Eigen::Vector3d> velocity;  ///< of the material [m/s]
  std::vector<Particles::Stress> stress;  ///< mean of the particles', or what it was last [Pa]
  /// sum_p V_p N_i(x_p) grad N_k(x_p) for the neighbours k of node i, x fastest [m2].
  std::vector<Eigen::Vector3d> coupling;

  int count() const { return static_cast<int>(index.size()); }
  double fraction(int i) const { return solid[i] / volume[i]; }
};

/// Neighbours of a node, itself included: (2 reach + 1)^d with Mesh::reach(); Nodes::coupling has
/// as many entries a node.
constexpr int neighbour_count(int dim, int reach) {
  const int side = 2 * reach + 1;
  return dim == 2 ? side * side : side * side * side;
}

/// The stencil of a particle among the active nodes. The gradients of nodes that are left out go to
/// the node that the particle is nearest to: what is left sums to 0, so that a translation has no
/// strain, wherever the particle is.
template <int D>
Stencil<D> active_stencil(const Nodes& nodes, const Eigen::Vector3d& x) {
  Stencil<D> s = stencil_at<D>(nodes.mesh, x);
  const auto nearest = static_cast<std::size_t>(std::max_element(s.weight.begin(), s.weight.end()) -
                                                s.weight.begin());
  for (std::size_t k = 0; k < s.node.size(); ++k) {
    if (nodes.slot_of[static_cast<std::size_t>(s.node[k])] >= 0) continue;
    s.gradient[nearest] += s.gradient[k];
    s.gradient[k].setZero();
  }
  return s;
}

/// Particles to grid. Momentum by APIC: sum V_p N_i (v_p + C_p (x_i - x_p)).
/// Cost: linear in the particles, 4^d products each; arrays of `nodes` are reused.
void scatter(const Scene& scene, const Particles& particles, Nodes& nodes);

/// Fills `covered`: what bodies take, by midpoint quadrature of 4^d samples a cell at nodes near
/// one; and the far half of a node on a closed barrier with sand on one side only.
void cover(const Scene& scene, const std::vector<RigidBody>& bodies, double time_s, Nodes& nodes);

/// Grid to particles: v_p, C_p, stress, inertial number, cohesion's decay; then x_p += h v_p.
/// `velocity` has one entry an active node; `stress` likewise, r/h.
void gather(const Scene& scene, const Nodes& nodes, const std::vector<Eigen::Vector3d>& velocity,
            const std::vector<Particles::Stress>& stress, double h, Particles& particles);

/// How many of the smallest cells the fastest particle would cross in h.
double cells_crossed(const Nodes& nodes, const std::vector<Eigen::Vector3d>& velocity,
                     const Particles& particles, double h);

}  // namespace conebench::mpm
