#pragma once

#include "dem/generators/generator.h"

namespace conebench::dem {

/// Generator: balls that touch, one on top of the other along z; each `growth` times as large as
/// the one below. A growth of 1 makes them equal, another a chain of mass ratio growth^3.
struct Stack {
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();  ///< where the lowest ball touches the ground
  std::int64_t count = 0;
  double radius_m = 0.0;  ///< of the lowest
  double growth = 1.0;    ///< > 0
  std::string material;
};

Stack read_stack(engine::TomlReader in);
std::string show(const Stack& stack);
void place(const Stack& stack, Nursery& nursery);

}  // namespace conebench::dem
