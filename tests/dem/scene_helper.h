#pragma once

#include <string>

#include "dem/scene.h"

namespace conebench::test {

/// A scene of "grain" bodies (density 2500) with one law and no plane; step 1e-3 s, skin 5e-3 m.
dem::Scene small_scene(const dem::PairLaw& law);

/// Adds the floor z = 0 of the same material.
void add_floor(dem::Scene& scene);

/// Adds a sphere and returns it for further settings.
dem::Body& add_body(dem::Scene& scene, const Eigen::Vector3d& position_m, double radius_m);

/// Adds a shape of one piece, and a body of a shape of the scene.
void add_shape(dem::Scene& scene, const std::string& name, const dem::Piece& piece);
dem::Body& add_body(dem::Scene& scene, const Eigen::Vector3d& position_m, const std::string& shape);

}  // namespace conebench::test
