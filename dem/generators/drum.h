#pragma once

#include "dem/generators/generator.h"

namespace conebench::dem {

/// Generator: a drum about an axis along y, one driven or fixed body: a ring of boxes that touch a
/// cylinder from outside, and a round plate at each end; in two dimensions the ring alone. What
/// turns it is a motion of the scene about the same axis.
struct Drum {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double radius_m = 0.0;     ///< of the cylinder
  double length_m = 0.0;     ///< between the plates
  double wall_m = 0.0;       ///< thickness of ring and plates
  std::int64_t staves = 24;  ///< >= 3
  std::string motion;        ///< empty: it stays
  std::string material;
};

Drum read_drum(engine::TomlReader in);
std::string show(const Drum& drum);
void place(const Drum& drum, Nursery& nursery);

}  // namespace conebench::dem
