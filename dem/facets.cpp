#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <span>
#include <utility>

#include "dem/shape.h"

namespace conebench::dem {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;

// A face of a hull takes in triangles whose unit normals differ by less.
constexpr double kSameNormal = 1e-6;

// A circle about the z axis, or a point of it where the radius is 0.
struct Ring {
  double radius = 0.0;
  double z = 0.0;
};

// The solid between rings that go up; flat below the first and above the last.
Polyhedron revolved(std::span<const Ring> rings, int around) {
  Polyhedron result;
  std::vector<std::vector<int>> levels;  // of each ring, `around` vertices
  for (const Ring& ring : rings) {
    std::vector<int>& level = levels.emplace_back();
    for (int k = 0; k < around; ++k) {
      if (k == 0 || ring.radius > 0.0) {
        const double angle = 2.0 * std::numbers::pi * k / around;
        result.vertices.emplace_back(ring.radius * std::cos(angle), ring.radius * std::sin(angle),
                                     ring.z);
      }
      level.push_back(static_cast<int>(result.vertices.size()) - 1);
    }
  }

  const auto add_face = [&](std::vector<int> face) {
    face.erase(std::unique(face.begin(), face.end()), face.end());
    if (face.size() > 1 && face.front() == face.back()) face.pop_back();
    if (face.size() > 2) result.faces.push_back(std::move(face));
  };
  add_face({levels.front().rbegin(), levels.front().rend()});
  for (std::size_t level = 0; level + 1 < levels.size(); ++level) {
    const std::vector<int>&low = levels[level], &high = levels[level + 1];
    for (std::size_t k = 0; k < low.size(); ++k) {
      const std::size_t beside = (k + 1) % low.size();
      add_face({low[k], low[beside], high[beside], high[k]});
    }
  }
  add_face(levels.back());
  return result;
}

// A capsule, or a ball where half_length_m is 0.
Polyhedron rounded(double radius_m, double half_length_m, int around) {
  const int steps = std::max(1, around / 4);  // from a pole to the equator
  const auto ring = [&](int side, int step) {
    const double from_pole = std::numbers::pi / 2.0 * step / steps;
    return Ring{radius_m * std::sin(from_pole),
                side * (half_length_m + radius_m * std::cos(from_pole))};
  };
  std::vector<Ring> rings;
  for (int step = 0; step <= steps; ++step) rings.push_back(ring(-1, step));
  for (int step = half_length_m > 0.0 ? steps : steps - 1; step >= 0; --step) {
    rings.push_back(ring(1, step));
  }
  return revolved(rings, around);
}

Polyhedron facets_of(const Ball& ball, int around) { return rounded(ball.radius_m, 0.0, around); }

Polyhedron facets_of(const Capsule& capsule, int around) {
  return rounded(capsule.radius_m, capsule.half_length_m, around);
}

Polyhedron facets_of(const Cylinder& cylinder, int around) {
  const double r = cylinder.radius_m, h = cylinder.half_length_m;
  return revolved(std::vector<Ring>{{r, -h}, {r, h}}, around);
}

// Bit i of a vertex's index says on which side of axis i it lies.
Polyhedron facets_of(const Box& box, int) {
  Polyhedron result;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Array3d side(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0);
    result.vertices.emplace_back(side * box.half_m.array());
  }
  result.faces = {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4},
                  {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}};
  return result;
}

using Edge = std::pair<int, int>;

Edge edge_of(const Vector3i& triangle, int k) { return {triangle(k), triangle((k + 1) % 3)}; }

// The triangles that lie in one face with the first of those left, which are taken out of `left`:
// its neighbours, their neighbours and so on.
std::vector<Vector3i> take_face(const std::vector<Vector3d>& points,
                                std::map<Edge, Vector3i>& left) {
  const auto normal = [&](const Vector3i& triangle) {
    const auto at = [&](int k) { return points[static_cast<std::size_t>(triangle(k))]; };
    return (at(1) - at(0)).cross(at(2) - at(0)).normalized().eval();
  };
  const Vector3d first = normal(left.begin()->second);
  std::vector<Vector3i> face;
  std::vector<Vector3i> found = {left.begin()->second};
  while (!found.empty()) {
    const Vector3i triangle = found.back();
    found.pop_back();
    if (!left.contains(edge_of(triangle, 0))) continue;
    face.push_back(triangle);
    for (int k = 0; k < 3; ++k) left.erase(edge_of(triangle, k));
    for (int k = 0; k < 3; ++k) {
      const auto [from, to] = edge_of(triangle, k);
      const auto beside = left.find({to, from});
      if (beside == left.end() || (normal(beside->second) - first).norm() > kSameNormal) continue;
      found.push_back(beside->second);
    }
  }
  return face;
}

// The loop of edges that only one of the triangles has.
std::vector<int> rim(const std::vector<Vector3i>& triangles) {
  std::set<Edge> edges;
  for (const Vector3i& triangle : triangles) {
    for (int k = 0; k < 3; ++k) edges.insert(edge_of(triangle, k));
  }
  std::map<int, int> next;
  for (const auto& [from, to] : edges) {
    if (!edges.contains({to, from})) next[from] = to;
  }
  std::vector<int> loop;
  for (int k = next.begin()->first; loop.size() < next.size(); k = next[k]) loop.push_back(k);
  return loop;
}

Polyhedron facets_of(const Hull& hull, int) {
  Polyhedron result{hull.points_m, {}};
  std::map<Edge, Vector3i> left;
  for (const Vector3i& triangle : hull_triangles(hull.points_m)) {
    for (int k = 0; k < 3; ++k) left[edge_of(triangle, k)] = triangle;
  }
  while (!left.empty()) result.faces.push_back(rim(take_face(hull.points_m, left)));
  return result;
}

Polyhedron facets_of(const Mesh& mesh, int) {
  Polyhedron result{mesh.vertices_m, {}};
  for (const Vector3i& t : mesh.triangles) result.faces.push_back({t(0), t(1), t(2)});
  return result;
}

}  // namespace

Polyhedron facets(const Piece& piece, int around) {
  return std::visit([&](const auto& kind) { return facets_of(kind, around); }, piece);
}

}  // namespace conebench::dem
