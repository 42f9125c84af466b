#pragma once

#include <vector>

#include "dem/closest_points.h"
#include "dem/narrow_phase.h"
#include "dem/outline.h"

namespace conebench::dem {

/// A face of one of two pieces that looks along the normal between them.
struct FacingFace {
  bool of_first = false;
  int face = -1;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< from the second to the first, exactly
};

/// All points in which two convex pieces touch, from where they are nearest. In the frame and the
/// unit of the placed pieces; keeps its arrays.
class Manifold {
 public:
  /// Within this angle of a normal a face counts as square to it [rad].
  static constexpr double kFacing = 1e-4;
  /// Points that are no farther apart are one.
  static constexpr double kSame = 1e-9;

  /// Appends the touches with gap < reach: of a face that meets anything the corners of what the
  /// two share as seen along the face's normal; of two sides that are all but parallel the ends of
  /// what they share; and the closest points where nothing else is as near.
  void add(const Placed& first, const Placed& second, const ClosestPoints& closest, double reach,
           const Inner* inner_of_second, std::vector<Touch>& out);

  /// Only the corners of what a face shares with the other piece.
  void add_along(const Placed& first, const Placed& second, const FacingFace& facing, double reach,
                 const Inner* inner_of_second, std::vector<Touch>& out);

 private:
  Outline first_, second_;
  std::vector<SharedPoint> shared_;
};

/// Drops touches, from `begin` on, that lie within `tolerance` of one before; the smaller gap
/// stays.
void merge_touches(std::vector<Touch>& touches, std::size_t begin, double tolerance);

}  // namespace conebench::dem
