#pragma once

#include "dem/generators/generator.h"

namespace conebench::dem {

enum class HopperForm { kCone, kWedge };

/// Generator: a hopper held in place; the walls are thick and convex. A cone is a ring of flat
/// staves about z, of which outlet_m and top_m are the widths from flat to flat. A wedge has two
/// inclined walls across x, and two upright ones at its ends across y; in two dimensions, where
/// there are no cones, the inclined walls alone. Equal widths make a tube, for a bin on top.
struct Hopper {
  HopperForm form = HopperForm::kCone;
  Eigen::Vector3d base_m = Eigen::Vector3d::Zero();  ///< middle of the outlet
  double outlet_m = 0.0;                             ///< width
  double top_m = 0.0;                                ///< width, >= outlet_m
  double height_m = 0.0;
  double length_m = 0.0;     ///< along y, of a wedge
  std::int64_t staves = 16;  ///< of a cone, >= 3
  double wall_m = 0.0;       ///< thickness
  bool lid = false;          ///< a plate below the outlet
  std::string lid_motion;    ///< that opens it; empty: it stays
  std::string material;
};

Hopper read_hopper(engine::TomlReader in);
std::string show(const Hopper& hopper);
void place(const Hopper& hopper, Nursery& nursery);

}  // namespace conebench::dem
