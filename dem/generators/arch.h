#pragma once

#include <numbers>

#include "dem/generators/generator.h"

namespace conebench::dem {

/// Generator: a circular arch in the plane of x and z. Equal wedges, between joints that point to
/// the middle of the circle, stand on two more of them that are held in place. Joints are
/// thickness_m deep; between them faces are flat, chords of the circles.
///
/// A semicircle stands under its own weight, with friction enough not to slide, where
/// thickness_m / mean_radius_m > 0.1075 (Couplet 1730; the number: Heyman, Int. J. Solids Struct.
/// 1969 and others since, 0.106 to 0.1075; not checked).
struct Arch {
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();  ///< half way between the two springings
  std::int64_t voussoirs = 0;
  double mean_radius_m = 0.0;
  double thickness_m = 0.0;               ///< < 2 mean_radius_m
  double depth_m = 0.0;                   ///< along y
  double embrace_rad = std::numbers::pi;  ///< angle from springing to springing
  std::string material;
};

Arch read_arch(engine::TomlReader in);
std::string show(const Arch& arch);
void place(const Arch& arch, Nursery& nursery);

}  // namespace conebench::dem
