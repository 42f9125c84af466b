#pragma once

#include <array>
#include <vector>

#include "mpm/assembly.h"

namespace conebench::mpm {

/// What walls and barriers do to one node.
struct NodeWalls {
  std::array<bool, 3> held{};    ///< this component of its velocity is 0
  std::array<bool, 3> smooth{};  ///< a slip wall has this normal: no shear stress on it
};

/// Of a node of the finest grid at this time. An opened barrier is not there.
NodeWalls walls_at(const Scene& scene, int node, double time_s);

/// True while any part of the barrier covers `x` (a point of its plane).
bool covers(const Barrier& barrier, const Eigen::Vector3d& gravity_m_s2, int dim,
            const Eigen::Vector3d& x, double time_s);

/// True while the barrier is at this node of the finest grid: not opened, nor drawn away from it.
/// A barrier lies strictly inside the grid, so the node has neighbours on both sides.
bool holds(const Scene& scene, const Barrier& barrier, int node, double time_s);

/// Cones of nodes at frictional walls and at bodies, and of bodies at walls.
std::vector<Interface> find_interfaces(const Scene& scene, const Nodes& nodes,
                                       const std::vector<RigidBody>& bodies);

}  // namespace conebench::mpm
