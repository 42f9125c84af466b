#include "tests/dem/shape_helper.h"

#include <map>
#include <utility>

namespace conebench::test {

using Eigen::Vector3d;

std::vector<dem::Piece> one_of_each_solid() {
  Draw draw(5);
  dem::Hull hull;
  for (int k = 0; k < 30; ++k) hull.points_m.push_back(draw.normal());
  return {dem::Ball{0.7}, dem::Box{{0.3, 0.5, 0.9}}, dem::Capsule{0.4, 0.8},
          dem::Cylinder{0.6, 0.35}, hull};
}

std::vector<Vector3d> moved(const std::vector<Vector3d>& points, const dem::Pose& pose) {
  std::vector<Vector3d> result;
  for (const Vector3d& point : points) result.push_back(pose * point);
  return result;
}

std::vector<Vector3d> grid(const Vector3d& half, int per_side) {
  std::vector<Vector3d> points;
  const auto at = [&](int k) { return 2.0 * k / (per_side - 1) - 1.0; };
  for (int i = 0; i < per_side; ++i) {
    for (int j = 0; j < per_side; ++j) {
      for (int k = 0; k < per_side; ++k) {
        points.emplace_back(half.x() * at(i), half.y() * at(j), half.z() * at(k));
      }
    }
  }
  return points;
}

// Bit i of a vertex's index says on which side of axis i it lies.
dem::Mesh box_mesh(const Vector3d& half) {
  dem::Mesh mesh;
  for (int k = 0; k < 8; ++k) {
    mesh.vertices_m.emplace_back((k & 1 ? 1.0 : -1.0) * half.x(), (k & 2 ? 1.0 : -1.0) * half.y(),
                                 (k & 4 ? 1.0 : -1.0) * half.z());
  }
  mesh.triangles = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
  return mesh;
}

dem::Mesh as_mesh(const dem::Polyhedron& polyhedron) {
  dem::Mesh mesh{polyhedron.vertices, {}};
  for (const std::vector<int>& face : polyhedron.faces) {
    for (std::size_t k = 2; k < face.size(); ++k) {
      mesh.triangles.emplace_back(face[0], face[k - 1], face[k]);
    }
  }
  return mesh;
}

bool is_closed(const std::vector<std::vector<int>>& faces) {
  std::map<std::pair<int, int>, int> uses;
  for (const std::vector<int>& face : faces) {
    for (std::size_t k = 0; k < face.size(); ++k) ++uses[{face[k], face[(k + 1) % face.size()]}];
  }
  for (const auto& [edge, count] : uses) {
    if (count != 1 || !uses.contains({edge.second, edge.first})) return false;
  }
  return !uses.empty();
}

}  // namespace conebench::test
