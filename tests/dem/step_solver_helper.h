#pragma once

#include "dem/step.h"

namespace conebench::test {

/// A step solver that shares no code with solvers/: Gauss-Seidel on the dense W, normal reaction
/// first, then the tangential one projected on the disc of radius mu r_n (no De Saxce shift, no
/// cone projection, own stopping test). Good for a few contacts.
/// `tol` is on the largest change of a sweep, as a velocity, relative to max |q|.
engine::StepSolver small_solver(double tol = 1e-14);

/// A scene of "grain" bodies (density 2500) with one law and no plane; step 1e-3 s, skin 5e-3 m.
dem::Scene small_scene(const dem::PairLaw& law);

/// Adds the floor z = 0 of the same material.
void add_floor(dem::Scene& scene);

/// Adds a sphere and returns it for further settings.
dem::Body& add_body(dem::Scene& scene, const Eigen::Vector3d& position_m, double radius_m);

}  // namespace conebench::test
