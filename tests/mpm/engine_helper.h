#pragma once

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "mpm/export.h"
#include "mpm/simulation.h"

namespace conebench::test {

/// A solver of solvers/, by its variant name, as the engine takes it.
engine::StepSolver step_solver(const std::string& variant, double tol);

/// "2D" or "3D", for suites with the dimension as parameter.
std::string dimension_name(const testing::TestParamInfo<int>& dimension);

inline constexpr double kGravity = 9.81;  ///< of the scenes below [m/s2]

/// An empty grid of cells of 0.1 m, as many dimensions as `cells` has entries, between free walls:
/// sand of density 1500, mu = 0.4, phi_max = 0.6, no cohesion; gravity down, step 2e-3 s.
mpm::Scene open_scene(const std::vector<int>& cells);

/// The same between slip walls that end on a floor of no slip.
mpm::Scene box_scene(const std::vector<int>& cells);

/// Adds a block of densest sand, in cells, and returns it for further settings.
mpm::Block& add_block(mpm::Scene& scene, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

/// A block in the air of an open scene, thrown so that it crosses cells askew.
mpm::Scene thrown(int dim);

/// The vector, its third entry 0 in two dimensions.
Eigen::Vector3d flat(int dim, Eigen::Vector3d x);

/// A step's problem and what it is made of.
struct Posed {
  mpm::Nodes nodes;
  mpm::Assembly assembly;
};

/// Particles to grid, and the assembly of a step of `h`.
Posed pose(const mpm::Scene& scene, const mpm::Particles& particles, double h,
           const std::vector<mpm::RigidBody>& bodies = {}, double time_s = 0.0);

/// Every particle of a scene at time 0.
mpm::Particles particles_of(const mpm::Scene& scene);

/// Total mass and momentum of the particles, and of the free bodies.
double mass_of(const mpm::Simulation& simulation);
Eigen::Vector3d momentum_of(const mpm::Simulation& simulation);

/// Calls step() `count` times.
void run(mpm::Simulation& simulation, int count);

}  // namespace conebench::test
