#pragma once

#include "mpm/nodes.h"
#include "mpm/simulation.h"
#include "problems/engine/heap.h"

namespace conebench::mpm {

/// The particles as they are now, each as large as the densest sand of its solid. Columns are a
/// cell of the grid wide.
engine::Heap heap_of(const Simulation& simulation);

/// By how much the densest node is fuller than phi_max, over phi_max: the largest
/// Phi_i / (phi_max (V_i - covered_i)) - 1 [-], over the nodes of which bodies leave a tenth;
/// negative where no node is full, -1 without nodes.
double overfull_share(const Scene& scene, const Nodes& nodes);

}  // namespace conebench::mpm
