#include "dem/convex.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "problems/error.h"

namespace conebench::dem {
namespace {

using Eigen::Vector3d;
using Corners = std::vector<int>;

// Of a hull's extent: triangles whose corners are no farther from one plane lie in it.
constexpr double kFlat = 1e-9;
// Sine of the angle from the axis of a disc below which a direction has no side.
constexpr double kAlongAxis = 1e-14;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

Vector3d area_vector(const std::vector<Vector3d>& points, const Corners& corners) {
  Vector3d sum = Vector3d::Zero();
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) {
    sum += (points[at(corners[k])] - points[at(corners[0])])
               .cross(points[at(corners[k + 1])] - points[at(corners[0])]);
  }
  return sum;
}

// Fills in normals and edges of a closed polyhedron.
void set_faces(Convex& convex, const std::vector<Corners>& polygons) {
  std::map<std::pair<int, int>, int> left;
  for (const Corners& corners : polygons) {
    const int face = static_cast<int>(convex.faces.size());
    convex.faces.push_back({area_vector(convex.points, corners).normalized(), corners});
    for (std::size_t k = 0; k < corners.size(); ++k) {
      left[{corners[k], corners[(k + 1) % corners.size()]}] = face;
    }
  }
  for (const auto& [ends, face] : left) {
    const auto& [from, to] = ends;
    if (from < to) convex.edges.push_back({from, to, face, left.at({to, from})});
  }
}

// The triangles of a hull, put together to flat faces.
class FlatFaces {
 public:
  FlatFaces(const std::vector<Vector3d>& points, const std::vector<Eigen::Vector3i>& triangles,
            double tolerance)
      : points_(points), triangles_(triangles), group_(triangles.size()) {
    std::iota(group_.begin(), group_.end(), 0);
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (int k = 0; k < 3; ++k) owner_[edge(t, k)] = static_cast<int>(t);
    }
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (int k = 0; k < 3; ++k) join_if_flat(t, k, tolerance);
    }
  }

  std::vector<Corners> polygons() {
    std::map<int, std::map<int, int>> next;  // group -> along its rim
    for (const auto& [ends, triangle] : owner_) {
      const int group = root(triangle);
      if (root(across(ends)) != group) next[group][ends.first] = ends.second;
    }
    std::vector<Corners> polygons;
    for (const auto& [group, rim] : next) polygons.push_back(corners(group, rim));
    return polygons;
  }

 private:
  using Ends = std::pair<int, int>;

  Ends edge(std::size_t t, int k) const { return {triangles_[t](k), triangles_[t]((k + 1) % 3)}; }
  int across(const Ends& ends) const { return owner_.at({ends.second, ends.first}); }

  int root(int t) {
    while (group_[at(t)] != t) t = group_[at(t)] = group_[at(group_[at(t)])];
    return t;
  }

  void join_if_flat(std::size_t t, int k, double tolerance) {
    const int other = across(edge(t, k));
    const auto& a = triangles_[t];
    const Vector3d origin = points_[at(a(0))];
    const Vector3d normal = (points_[at(a(1))] - origin).cross(points_[at(a(2))] - origin);
    const auto& b = triangles_[at(other)];
    for (int c = 0; c < 3; ++c) {
      const double height = normal.dot(points_[at(b(c))] - origin);
      if (std::abs(height) > tolerance * normal.norm()) return;
    }
    group_[at(root(static_cast<int>(t)))] = root(other);
  }

  // Without points inside a straight side: there the same two faces meet before and after.
  Corners corners(int group, const std::map<int, int>& rim) {
    Corners corners;
    int before = rim.begin()->first;
    for (std::size_t k = 0; k < rim.size(); ++k) {
      const int here = rim.at(before);
      const int there = rim.at(here);
      if (root(across({before, here})) != root(across({here, there}))) corners.push_back(here);
      before = here;
    }
    problems::require(corners.size() >= 3, "hull", "face ", group, " has ", corners.size(),
                      " corners, expected at least 3");
    return corners;
  }

  const std::vector<Vector3d>& points_;
  const std::vector<Eigen::Vector3i>& triangles_;
  std::vector<int> group_;
  std::map<Ends, int> owner_;
};

Convex segment(double half_length) {
  Convex convex;
  convex.points = {Vector3d(0.0, 0.0, -half_length), Vector3d(0.0, 0.0, half_length)};
  convex.edges = {{0, 1}};
  return convex;
}

Convex make(const Ball& ball) {
  Convex convex;
  convex.points = {Vector3d::Zero()};
  convex.radius = ball.radius_m;
  return convex;
}

Convex make(const Box& box) {
  Convex convex;
  for (int k = 0; k < 8; ++k) {
    const Vector3d corner(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0);
    convex.points.push_back(box.half_m.cwiseProduct(corner));
  }
  set_faces(convex,
            {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}});
  return convex;
}

Convex make(const Capsule& capsule) {
  Convex convex = segment(capsule.half_length_m);
  convex.radius = capsule.radius_m;
  return convex;
}

Convex make(const Cylinder& cylinder) {
  Convex convex = segment(cylinder.half_length_m);
  convex.disc = cylinder.radius_m;
  convex.faces = {{-Vector3d::UnitZ(), {0}}, {Vector3d::UnitZ(), {1}}};
  return convex;
}

Convex make(const Hull& hull) {
  const auto triangles = hull_triangles(hull.points_m);
  problems::require(!triangles.empty(), "hull", "its points lie in a plane, expected a volume");
  std::map<int, int> kept;  // corners alone
  for (const auto& triangle : triangles) {
    for (const int corner : triangle) kept[corner] = 0;
  }
  Convex convex;
  Vector3d low = hull.points_m[at(triangles[0](0))], high = low;
  for (auto& [corner, index] : kept) {
    index = static_cast<int>(convex.points.size());
    convex.points.push_back(hull.points_m[at(corner)]);
    low = low.cwiseMin(convex.points.back());
    high = high.cwiseMax(convex.points.back());
  }
  convex.centre = 0.5 * (low + high);
  for (Vector3d& point : convex.points) point -= convex.centre;
  auto renamed = triangles;
  for (auto& triangle : renamed) triangle = triangle.unaryExpr([&](int k) { return kept.at(k); });
  set_faces(convex, FlatFaces(convex.points, renamed, kFlat * (high - low).norm()).polygons());
  return convex;
}

Convex make(const Mesh&) {
  problems::require(false, "mesh", "not convex, expected a convex piece");
  return {};
}

}  // namespace

Convex make_convex(const Piece& piece) {
  Convex convex = std::visit([](const auto& kind) { return make(kind); }, piece);
  for (const Vector3d& point : convex.points) {
    convex.extent = std::max(convex.extent, std::hypot(point.norm(), convex.disc) + convex.radius);
  }
  return convex;
}

Convex make_triangle() {
  Convex convex;
  convex.points.resize(3, Vector3d::Zero());
  set_faces(convex, {{0, 1, 2}, {0, 2, 1}});
  return convex;
}

void Placed::place(const Convex& what, const Vector3d& position, const Eigen::Matrix3d& turn,
                   double unit_m) {
  convex = &what;
  centre = position;
  radius = what.radius / unit_m;
  disc = what.disc / unit_m;
  rotation = turn;
  points.clear();
  for (const Vector3d& point : what.points) points.push_back(position + turn * point / unit_m);
  normals.clear();
  for (const Convex::Face& face : what.faces) normals.push_back(turn * face.normal);
}

int Placed::farthest(const Vector3d& direction) const {
  int best = 0;
  double most = points[0].dot(direction);
  for (std::size_t k = 1; k < points.size(); ++k) {
    const double here = points[k].dot(direction);
    if (here <= most) continue;
    most = here;
    best = static_cast<int>(k);
  }
  return best;
}

Vector3d Placed::to_rim(const Vector3d& direction) const {
  if (disc == 0.0) return Vector3d::Zero();
  const Vector3d along = axis();
  Vector3d radial = direction - along * along.dot(direction);
  if (radial.norm() <= kAlongAxis * direction.norm()) return Vector3d::Zero();
  radial -= along * along.dot(radial);  // what rounding has left
  return radial * (disc / radial.norm());
}

}  // namespace conebench::dem
