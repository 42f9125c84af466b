#pragma once

#include "mpm/scene.h"

namespace conebench::mpm {

// What the parts of a scene must be to fit the grid and each other. `in` is the reader of the
// part's own table: it gives errors their line and key. Internal to the scene parser.

/// On a plane of nodes and inside the grid; a door rises along an axis that lies in it.
void check_barrier(const engine::TomlReader& in, const Scene& scene, const Barrier& barrier);

/// Inside the grid and apart from the blocks that the scene has so far.
void check_block(const engine::TomlReader& in, const Scene& scene, const Block& block);

/// Two cells thick; moves and weighs what its motion says.
void check_body(const engine::TomlReader& in, const Grid& grid, const Body& body);

}  // namespace conebench::mpm
