#pragma once

#include <optional>
#include <vector>

#include "dem/generators/generator.h"

namespace conebench::dem {

/// Generator: a cloud of bodies that fall and come to rest as they may. A box is cut into equal
/// cells, each just large enough for a ball about the largest body; they are filled layer by layer
/// from below, each with a body turned at random and moved at random in the room that its cell
/// leaves it. A narrow and high box pours a heap. In two dimensions one row of cells in the plane.
struct Deposition {
  Eigen::Vector3d low_m = Eigen::Vector3d::Zero(), high_m = Eigen::Vector3d::Zero();
  std::optional<std::int64_t> count;  ///< as many as there are cells, if missing
  std::vector<std::string> shapes;    ///< none: balls
  bool in_turn = true;                ///< the shapes; else each drawn at random
  double smallest_radius_m = 0.0;     ///< of the balls
  double largest_radius_m = 0.0;
  double jitter = 1.0;  ///< share of the free room that is used [-], 0..1
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  std::string material;
};

Deposition read_deposition(engine::TomlReader in);
std::string show(const Deposition& deposition);
void place(const Deposition& deposition, Nursery& nursery);

}  // namespace conebench::dem
