#include "dem/surface_mesh.h"

#include <BulletCollision/CollisionShapes/btBvhTriangleMeshShape.h>
#include <BulletCollision/CollisionShapes/btTriangleCallback.h>
#include <BulletCollision/CollisionShapes/btTriangleIndexVertexArray.h>

#include <algorithm>
#include <array>
#include <map>
#include <numbers>
#include <utility>

#include "problems/error.h"

namespace conebench::dem {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double kSupport = 1e-6;  // sines of angles
constexpr double kFlat = 1e-4;
constexpr double kSharp = std::numbers::sqrt2 / 2.0;  // cosine

std::size_t at(int k) { return static_cast<std::size_t>(k); }

btVector3 to_bullet(const Vector3d& x) { return {x.x(), x.y(), x.z()}; }

class Collect final : public btTriangleCallback {
 public:
  explicit Collect(std::vector<int>& found) : found_(found) {}
  void processTriangle(btVector3*, int, int triangle) override { found_.push_back(triangle); }

 private:
  std::vector<int>& found_;
};

// The index of the first vertex at the same place.
std::vector<int> first_at_place(const std::vector<Vector3d>& vertices) {
  std::map<std::array<double, 3>, int> first;
  std::vector<int> same;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const Vector3d x = vertices[v] + Vector3d::Zero();  // -0 + 0 = 0
    same.push_back(first.try_emplace({x.x(), x.y(), x.z()}, static_cast<int>(v)).first->second);
  }
  return same;
}

}  // namespace

// Refers to the arrays of the mesh, which keep their place when it is moved.
class SurfaceMesh::Tree {
 public:
  Tree(const std::vector<Vector3i>& triangles, const std::vector<Vector3d>& vertices)
      : arrays_(static_cast<int>(triangles.size()), const_cast<int*>(triangles[0].data()),
                sizeof(Vector3i), static_cast<int>(vertices.size()),
                const_cast<double*>(vertices[0].data()), sizeof(Vector3d)),
        shape_(&arrays_, false) {}

  void find(const Bounds& bounds, std::vector<int>& found) const {
    Collect collect(found);
    shape_.processAllTriangles(&collect, to_bullet(bounds.low), to_bullet(bounds.high));
  }

 private:
  btTriangleIndexVertexArray arrays_;
  btBvhTriangleMeshShape shape_;
};

SurfaceMesh::SurfaceMesh(const Mesh& mesh)
    : vertices_(mesh.vertices_m), triangles_(mesh.triangles) {
  problems::require(!triangles_.empty(), "mesh", "no triangles, expected at least one");
  const std::vector<int> same = first_at_place(vertices_);
  for (Vector3i& triangle : triangles_) {
    triangle = triangle.unaryExpr([&](int v) { return same[at(v)]; }).eval();
    const Vector3d &a = vertex(triangle(0)), &b = vertex(triangle(1)), &c = vertex(triangle(2));
    normals_.push_back((b - a).cross(c - a).normalized());
  }
  find_neighbours();
  tree_ = std::make_unique<Tree>(triangles_, vertices_);
}

SurfaceMesh::~SurfaceMesh() = default;
SurfaceMesh::SurfaceMesh(SurfaceMesh&&) noexcept = default;
SurfaceMesh& SurfaceMesh::operator=(SurfaceMesh&&) noexcept = default;

void SurfaceMesh::find_neighbours() {
  const int count = static_cast<int>(triangles_.size());
  std::map<std::pair<int, int>, std::vector<int>> sides;  // ends -> indices of sides
  for (int t = 0; t < count; ++t) {
    for (int k = 0; k < 3; ++k) {
      sides[std::minmax(triangles_[at(t)](k), triangles_[at(t)]((k + 1) % 3))].push_back(3 * t + k);
    }
  }
  across_.resize(3 * triangles_.size());
  neighbours_.resize(vertices_.size());
  for (const auto& [ends, here] : sides) {
    neighbours_[at(ends.first)].push_back(ends.second);
    neighbours_[at(ends.second)].push_back(ends.first);
    for (const int side : here) {
      for (const int other : here) {
        if (other == side) continue;
        across_[at(side)].push_back({other / 3, triangles_[at(other / 3)]((other + 2) % 3)});
      }
    }
  }
}

void SurfaceMesh::find(const Bounds& bounds, std::vector<int>& found) const {
  found.clear();
  tree_->find(bounds, found);
  std::sort(found.begin(), found.end());
}

const Vector3d& SurfaceMesh::corner(int triangle, int k) const {
  return vertex(triangles_[at(triangle)](k));
}

const Vector3d& SurfaceMesh::normal(int triangle) const { return normals_[at(triangle)]; }

bool SurfaceMesh::supports(int triangle, int corners, const Vector3d& direction) const {
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    const bool alone = corners == 1 << k, side = corners == (1 << k | 1 << next);
    if (!alone && !side) continue;
    const Vector3d& here = corner(triangle, k);
    const auto higher = [&](int v) {
      const Vector3d way = vertex(v) - here;
      return direction.dot(way) > kSupport * way.norm();
    };
    if (alone) {
      const auto& around = neighbours_[at(triangles_[at(triangle)](k))];
      return std::none_of(around.begin(), around.end(), higher);
    }
    const auto& across = across_[side_index(triangle, k)];
    return std::none_of(across.begin(), across.end(),
                        [&](const Across& other) { return higher(other.vertex); });
  }
  return true;
}

void SurfaceMesh::normals_across_sharp_sides(int triangle, std::vector<Vector3d>& normals) const {
  normals.clear();
  for (int k = 0; k < 3; ++k) {
    for (const Across& other : across_[side_index(triangle, k)]) {
      if (normal(other.triangle).dot(normal(triangle)) < kSharp) {
        normals.push_back(normal(other.triangle));
      }
    }
  }
}

Inner SurfaceMesh::inner(int triangle, double side) const {
  Inner inner;
  for (int k = 0; k < 3; ++k) {
    const Vector3d& here = corner(triangle, k);
    const auto& across = across_[side_index(triangle, k)];
    inner.sides[at(k)] = std::any_of(across.begin(), across.end(), [&](const Across& other) {
      const Vector3d way = vertex(other.vertex) - here;
      return side * normal(triangle).dot(way) >= -kFlat * way.norm();
    });
  }
  for (std::size_t k = 0; k < 3; ++k) {
    inner.corners[k] = inner.sides[k] && inner.sides[(k + 2) % 3];
  }
  return inner;
}

}  // namespace conebench::dem
