#pragma once

#include "dem/generators/generator.h"

namespace conebench::dem {

enum class Section { kBox, kCylinder };

/// Generator: balls of random radii on a cubic lattice of spacing 2 max(radius), each moved at
/// random in the room that its cell leaves it, layer by layer from the base upwards. In two
/// dimensions one row of them.
struct Column {
  Section section = Section::kBox;
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();  ///< centre of the base; the axis is z
  double width_m = 0.0;                              ///< side of the square, or diameter
  double height_m = 0.0;
  double smallest_radius_m = 0.0;
  double largest_radius_m = 0.0;
  double jitter = 1.0;  ///< share of the free room that is used [-], 0..1
  std::string material;
};

Column read_column(engine::TomlReader in);
std::string show(const Column& column);
void place(const Column& column, Nursery& nursery);

}  // namespace conebench::dem
