#pragma once

#include "mpm/particles.h"
#include "mpm/rigid_body.h"

namespace conebench::mpm {

/// The particles of a scene at time 0, block by block: a lattice that fills the block, its spacing
/// as near to the grid's as whole numbers allow, each particle moved at random by `jitter` of the
/// room it has. Those inside a rigid body are left out. The same seed gives the same particles on
/// every machine.
///
/// Errors: InputError when no particle is left.
Particles place_particles(const Scene& scene, const std::vector<RigidBody>& bodies);

}  // namespace conebench::mpm
