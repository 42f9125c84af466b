#pragma once

#include <optional>
#include <vector>

#include "dem/manifold.h"
#include "dem/surface_mesh.h"

namespace conebench::dem {

/// The touches of a ball or a convex piece with a mesh: those with its triangles one by one,
/// without what inner edges and corners would add. Keeps its arrays.
///
/// Cost: of each triangle whose box is within reach the closest points and a manifold.
class MeshTouches {
 public:
  MeshTouches();

  /// Appends the touches with gap < reach; normals from the mesh.
  void add(const Convex& first, const Pose& first_pose, const SurfaceMesh& mesh,
           const Pose& mesh_pose, double reach, std::vector<Touch>& out);
  void add_ball(const Eigen::Vector3d& centre, double radius, const SurfaceMesh& mesh,
                const Pose& mesh_pose, double reach, std::vector<Touch>& out);

 private:
  void find_about(const SurfaceMesh& mesh, const Eigen::Vector3d& centre, double unit,
                  double reach);
  void place_triangle(const SurfaceMesh& mesh, int t, const Eigen::Vector3d& centre, double unit);
  void add_triangle(const SurfaceMesh& mesh, int t, double reach, std::optional<Touch>& overlap,
                    std::vector<Touch>& out);
  bool separates_best(const SurfaceMesh& mesh, int t, double side);

  Convex triangle_;
  Placed first_, second_;  // the piece, and one triangle after the other
  Manifold manifold_;
  std::vector<int> found_;
  std::vector<Eigen::Vector3d> normals_;
};

}  // namespace conebench::dem
