#pragma once

#include <Eigen/Geometry>

#include "dem/generators/generator.h"

namespace conebench::dem {

/// The room that a body takes up, in the frame of its shape: the box about it, and a ball about
/// the middle of that box, which holds it however it is turned.
struct Extent {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_m = Eigen::Vector3d::Zero();  ///< half of each side of the box
  double radius_m = 0.0;                             ///< of the ball
};

Extent extent_of(const Solid& solid);

/// Any turn alike (Shoemake, Graphics Gems III, 1992; not checked); in two dimensions about y.
Eigen::Quaterniond random_turn(Nursery& nursery);

/// A vector of numbers that are all > 0.
Eigen::Vector3d read_size(engine::TomlReader& in, std::string_view key);

}  // namespace conebench::dem
