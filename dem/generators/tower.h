#pragma once

#include "dem/generators/generator.h"

namespace conebench::dem {

/// Generator: a tower of planks, as children build them: level upon level of planks side by side,
/// evenly spread over a square as wide as a plank is long, along x and along y in turn. In two
/// dimensions its cut: one plank along x, then planks seen from their ends.
struct Tower {
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();  ///< middle of its base
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< of a plank: length, width, height
  std::int64_t levels = 0;
  std::int64_t planks = 0;  ///< of a level
  std::string material;
};

Tower read_tower(engine::TomlReader in);
std::string show(const Tower& tower);
void place(const Tower& tower, Nursery& nursery);

}  // namespace conebench::dem
