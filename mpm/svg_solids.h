#pragma once

#include <string>
#include <vector>

#include "mpm/rigid_body.h"
#include "problems/engine/svg.h"

namespace conebench::mpm {

/// All of the grid: plain in 2D, along engine::oblique_axes() in 3D.
engine::Window window_of(const Scene& scene);

/// What a picture shows around the material, as SVG. Internal to svg_frame.cpp.
class SolidsDrawing {
 public:
  /// Keeps references to both.
  SolidsDrawing(const Scene& scene, const engine::Camera& camera);

  /// Cell lines where cells are large enough (2D; cut ones as Mesh::cut() has them), walls, half
  /// spaces: behind the material.
  std::string behind(const std::vector<RigidBody>& bodies, const std::vector<bool>& cut) const;

  /// The faces of cells that a barrier still covers.
  std::string barrier(const Barrier& barrier, double time_s) const;

  /// A ball or a box; a half space is drawn by behind().
  std::string body(const RigidBody& body) const;

 private:
  using Polygon = std::vector<Eigen::Vector3d>;

  std::string path(const Polygon& polygon) const;
  Polygon rectangle(int axis, double place, const Eigen::Vector3d& low,
                    const Eigen::Vector3d& high) const;
  Polygon half_space(const RigidBody& body) const;
  std::string cell_lines(const std::vector<bool>& cut) const;
  std::string walls() const;
  std::string box(const RigidBody& body) const;

  const Scene& scene_;
  const engine::Camera& camera_;
  Eigen::Vector3d low_, high_;  // of the grid
};

}  // namespace conebench::mpm
