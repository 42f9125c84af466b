#pragma once

#include "dem/generators/generator.h"

namespace conebench::dem {

/// Generator: equal balls packed as densely as can be (face-centred cubic, one of them in the
/// middle; in two dimensions triangular) inside a sphere, flying together. They touch, so that they
/// hold together where their material's law has bonds.
struct Clump {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;       ///< of the sphere that holds the balls
  double ball_radius_m = 0.0;  ///< <= radius_m
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  std::string material;
};

Clump read_clump(engine::TomlReader in);
std::string show(const Clump& clump);
void place(const Clump& clump, Nursery& nursery);

}  // namespace conebench::dem
