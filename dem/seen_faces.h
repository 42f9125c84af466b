#pragma once

#include <span>
#include <vector>

#include "dem/paint_order.h"
#include "dem/solid.h"
#include "problems/engine/svg.h"

namespace conebench::dem {

/// A face of a solid in a picture.
struct Face {
  Patch patch;
  bool seamless = false;  ///< its edges are not those of the solid
  bool before = false;    ///< its part stands between the eye and the middle
};

/// The faces of solids, ready to be turned and looked at.
class SeenFaces {
 public:
  /// For pictures of this scale: what is round gets as many facets as it takes to look round.
  SeenFaces(std::span<const Solid> solids, double scale_px_m);

  /// Those of a solid's boxes, cylinders and hulls that are turned to the eye, and all of its
  /// meshes, whose both sides can be seen. Balls and capsules have none. A part stands before
  /// `middle` if most of the area of these faces does, each face of a mesh if it does.
  std::vector<Face> of(int solid, const Pose& pose, const engine::Camera& camera,
                       const Eigen::Vector3d& middle_m) const;

 private:
  struct Surface {
    Polyhedron polyhedron;  // in the body's frame
    bool mesh = false;
    bool cylinder = false;
  };
  static std::vector<Face> seen(const Surface& surface, const Pose& pose,
                                const engine::Camera& camera, const Eigen::Vector3d& middle_m);

  std::vector<std::vector<Surface>> surfaces_;  // of each solid
};

}  // namespace conebench::dem
