#pragma once

#include "dem/generators/generator.h"

namespace conebench::dem {

/// Generator: a rough floor of equal balls held in place on a square lattice, touching. In two
/// dimensions one row of them.
struct Bed {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();  ///< of the layer: all centres at its z
  double width_m = 0.0;                                ///< side of the square that is covered
  double radius_m = 0.0;
  std::string material;
};

Bed read_bed(engine::TomlReader in);
std::string show(const Bed& bed);
void place(const Bed& bed, Nursery& nursery);

}  // namespace conebench::dem
