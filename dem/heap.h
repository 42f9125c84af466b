#pragma once

#include "dem/simulation.h"
#include "problems/engine/heap.h"

namespace conebench::dem {

/// The free bodies as they are now, each as a ball of its volume. Columns are 3 mean radii wide.
engine::Heap heap_of(const Simulation& simulation);

}  // namespace conebench::dem
