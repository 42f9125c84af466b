#pragma once

#include <memory>
#include <span>
#include <vector>

#include "dem/shape.h"

namespace conebench::dem {

/// One point where two pieces touch or nearly do.
struct Touch {
  Eigen::Vector3d point;   ///< in the middle of the gap [m]
  Eigen::Vector3d normal;  ///< from the second towards the first, unit length
  double gap = 0.0;        ///< < 0: overlap [m]
};

/// The contact points of pieces other than two balls.
///
/// Balls by formulas; others by closest_points() and the corners of what facing sides share
/// (Manifold); triangles of meshes by Bullet's tree of boxes. Gaps are exact to about 1e-9 of the
/// size of the smaller piece.
///
/// Pieces are prepared once. A call depends on nothing but its arguments, so that a run repeats
/// bit for bit from any step. Flat faces that meet give all corners of what they share; a face
/// normal is taken as the normal where it is within 1e-4 rad of the one that was found.
///
/// Bullet's own narrow phase would not do: its closest points end up to 7e-5 of a piece's size and
/// 0.04 rad from the nearest ones (tests/dem/narrow_phase_bullet_test.cpp), where a gap of 1e-9
/// forms a bond; it keeps at most four points a pair, those of round pieces gathered over several
/// steps, so that what it finds depends on more than where the pieces are.
///
/// Errors: InputError where two meshes meet: that is not treated.
class NarrowPhase {
 public:
  explicit NarrowPhase(std::span<const Piece> pieces);
  ~NarrowPhase();
  NarrowPhase(NarrowPhase&&) noexcept;
  NarrowPhase& operator=(NarrowPhase&&) noexcept;

  /// Appends the touches with gap < reach of piece `first` with piece `second`, in an order that
  /// depends on the arguments alone. Empty where the pieces are farther apart.
  void touches(int first, const Pose& first_pose, int second, const Pose& second_pose, double reach,
               std::vector<Touch>& out);

  /// The same of a ball with piece `second`. At most one touch, but with a mesh.
  void ball_touches(const Eigen::Vector3d& centre, double radius, int second,
                    const Pose& second_pose, double reach, std::vector<Touch>& out);

 private:
  class Library;
  std::unique_ptr<Library> library_;
};

/// Appends the touches with gap < reach of a convex piece with the half-space below a plane through
/// `at` with unit `normal` (out of the solid): the corners of boxes and hulls, the two ends of
/// capsules, and of each end of a cylinder its deepest point and, a quarter and half a turn from
/// there, three more. Exact.
void plane_touches(const Piece& piece, const Pose& pose, const Eigen::Vector3d& at,
                   const Eigen::Vector3d& normal, double reach, std::vector<Touch>& out);

}  // namespace conebench::dem
