#pragma once

#include "mpm/mesh.h"
#include "mpm/particles.h"
#include "mpm/scene.h"

namespace conebench::mpm {

/// A cell that holds less than this share of the densest sand is open: outside of the heap.
inline constexpr double kOpenShare = 0.5;

/// The cells at the heap's boundary: those that have sand, and an open cell, in themselves or in a
/// cell that touches them. So the boundary has a layer of halves on both sides. The grid's walls
/// are no boundary; what bodies take of a cell is open. One entry a cell of the scene's grid.
/// Cost: linear in the particles and the cells.
std::vector<bool> boundary_cells(const Scene& scene, const Particles& particles);

/// The cells of a step for the particles as they are at its beginning.
Mesh mesh_for(const Scene& scene, const Particles& particles);

}  // namespace conebench::mpm
