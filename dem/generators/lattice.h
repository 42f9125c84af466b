#pragma once

#include <optional>

#include "dem/generators/generator.h"

namespace conebench::dem {

enum class Arrangement { kCubic, kFcc };

/// Generator: equal bodies on a regular lattice, layer by layer from the base upwards.
///
/// Cubic: one above the other. By default neighbours touch: balls, the boxes about shapes, or the
/// balls about shapes that are turned at random.
/// Fcc, for balls: every other layer moved by half a spacing along x and y, into the hollows of the
/// one below. By default balls touch those beside, above and below them. In two dimensions the
/// layers are rows in the plane, moved along x.
struct Lattice {
  std::string shape;                                 ///< empty: balls
  double radius_m = 0.0;                             ///< of the balls
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();  ///< middle of the base of the box about it all
  Eigen::Vector3i counts = Eigen::Vector3i::Zero();  ///< along x, y and z; y: 1 in two dimensions
  /// From centre to centre along x and y, and from layer to layer.
  std::optional<Eigen::Vector3d> spacing_m;
  Arrangement arrangement = Arrangement::kCubic;
  bool random_rotation = false;  ///< of shapes
  std::string material;
};

Lattice read_lattice(engine::TomlReader in);
std::string show(const Lattice& lattice);
void place(const Lattice& lattice, Nursery& nursery);

}  // namespace conebench::dem
