#pragma once

#include <array>
#include <vector>

#include "mpm/nodes.h"
#include "problems/sparse.h"

namespace conebench::mpm {

/// K with v . K v = int 2 eta phi |D(v)|^2, by quadrature at the particles: the force of a
/// Newtonian viscosity eta is -K v. `dof` names the unknowns of each active node, -1: held.
problems::SparseMatrix viscous_form(const Scene& scene, const Particles& particles,
                                    const Nodes& nodes, const std::vector<std::array<int, 3>>& dof,
                                    int dofs);

}  // namespace conebench::mpm
