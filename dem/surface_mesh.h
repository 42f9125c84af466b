#pragma once

#include <memory>
#include <vector>

#include "dem/outline.h"
#include "dem/shape.h"

namespace conebench::dem {

/// A mesh made ready for the narrow phase: which triangles are near (Bullet's tree of boxes), and
/// how the surface goes on beyond each of them. Corners at the same place are one.
class SurfaceMesh {
 public:
  explicit SurfaceMesh(const Mesh& mesh);
  ~SurfaceMesh();
  SurfaceMesh(SurfaceMesh&&) noexcept;
  SurfaceMesh& operator=(SurfaceMesh&&) noexcept;

  /// Replaces `found` by the triangles whose boxes meet the given one, in increasing order.
  void find(const Bounds& bounds, std::vector<int>& found) const;

  const Eigen::Vector3d& corner(int triangle, int k) const;
  const Eigen::Vector3d& normal(int triangle) const;

  /// Whether nothing of the surface around what lies between some corners of a triangle (bit k:
  /// corner k) is higher along a unit vector, to 1e-6 rad: only there can a body touch from that
  /// direction that is nearest to that place.
  bool supports(int triangle, int corners, const Eigen::Vector3d& direction) const;

  /// Appends to `normals`, cleared first, those of the triangles beyond its sides that are turned
  /// by more than 45 degrees against its own.
  void normals_across_sharp_sides(int triangle, std::vector<Eigen::Vector3d>& normals) const;

  /// The sides beyond which the surface, seen from `side` (1 or -1) times the normal, goes on
  /// flat (to 1e-4 rad) or upwards, and the corners between two such.
  Inner inner(int triangle, double side) const;

 private:
  class Tree;
  /// A triangle on the other side of a side, and its corner there.
  struct Across {
    int triangle = 0;
    int vertex = 0;
  };

  void find_neighbours();
  const Eigen::Vector3d& vertex(int v) const { return vertices_[static_cast<std::size_t>(v)]; }
  std::size_t side_index(int triangle, int k) const {
    return static_cast<std::size_t>(3 * triangle + k);
  }

  std::vector<Eigen::Vector3d> vertices_;
  std::vector<Eigen::Vector3i> triangles_;
  std::vector<Eigen::Vector3d> normals_;
  std::vector<std::vector<Across>> across_;   // of each side
  std::vector<std::vector<int>> neighbours_;  // of each vertex
  std::unique_ptr<Tree> tree_;
};

}  // namespace conebench::dem
