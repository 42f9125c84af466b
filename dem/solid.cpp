#include "dem/solid.h"

#include <limits>

namespace conebench::dem {
namespace {

// Half the sides of the box about it.
Eigen::Vector3d half_sides(const Shape& shape) {
  Eigen::AlignedBox3d box;
  for (const Part& part : shape.parts) {
    const Bounds bounds = bounds_of(part.piece, part.pose);
    box.extend(bounds.low);
    box.extend(bounds.high);
  }
  return 0.5 * box.sizes();
}

}  // namespace

Solid make_solid(const Shape& shape, std::vector<Piece>& pieces) {
  Solid solid;
  if (!shape.has_mesh()) {
    const MassProperties mass = mass_properties(shape);
    const PrincipalAxes principal = principal_axes(mass.inertia_m5);
    solid.from_shape = Pose{mass.centre_m, Eigen::Quaterniond(principal.axes)}.inverse();
    solid.volume_m3 = mass.volume_m3;
    solid.moments_m5 = principal.moments;
  }
  for (const Part& part : shape.parts) {
    solid.parts.push_back({part.piece, solid.from_shape * part.pose});
    solid.pieces.push_back(static_cast<int>(pieces.size()));
    pieces.push_back(part.piece);
  }
  const Eigen::Vector3d half = half_sides(shape);
  solid.size_m = half.maxCoeff();
  solid.thinness_m = shape.has_mesh() ? std::numeric_limits<double>::infinity() : half.minCoeff();
  return solid;
}

}  // namespace conebench::dem
