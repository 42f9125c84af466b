#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <utility>

#include "dem/shape.h"
#include "problems/error.h"

namespace conebench::dem {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using problems::require;

// Of its longest edge: a triangle lower than this has no normal to speak of.
constexpr double kNoArea = 1e-12;
// Of its extent: a closed surface thinner than this encloses nothing.
constexpr double kFlat = 1e-9;

void check_size(std::string_view subject, std::string_view key, double size_m) {
  require(std::isfinite(size_m) && size_m > 0.0, subject, key, " is ", size_m,
          ", expected > 0 and finite");
}

void check_points(std::string_view subject, std::string_view what,
                  const std::vector<Vector3d>& points) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    require(points[k].allFinite(), subject, what, " ", k, " is (", points[k].transpose(),
            "), expected finite numbers");
  }
}

void check(const Ball& ball, std::string_view subject, bool) {
  check_size(subject, "radius_m", ball.radius_m);
}

void check(const Box& box, std::string_view subject, bool) {
  for (const double half : box.half_m) check_size(subject, "an entry of half_m", half);
}

void check(const Capsule& capsule, std::string_view subject, bool) {
  check_size(subject, "radius_m", capsule.radius_m);
  check_size(subject, "half_length_m", capsule.half_length_m);
}

void check(const Cylinder& cylinder, std::string_view subject, bool) {
  check_size(subject, "radius_m", cylinder.radius_m);
  check_size(subject, "half_length_m", cylinder.half_length_m);
}

void check(const Hull& hull, std::string_view subject, bool) {
  check_points(subject, "point", hull.points_m);
  require(hull.points_m.size() >= 4, subject, "a hull of ", hull.points_m.size(),
          " points, expected at least 4");
  require(!hull_triangles(hull.points_m).empty(), subject, "all ", hull.points_m.size(),
          " points of the hull lie in a plane, expected a volume");
}

// The corners as columns.
Eigen::Matrix3d corners(const Mesh& mesh, const Vector3i& triangle) {
  Eigen::Matrix3d result;
  for (int k = 0; k < 3; ++k) {
    result.col(k) = mesh.vertices_m[static_cast<std::size_t>(triangle(k))];
  }
  return result;
}

// Twice the area, along the normal.
Vector3d doubled_area(const Eigen::Matrix3d& corner) {
  return (corner.col(1) - corner.col(0)).cross(corner.col(2) - corner.col(0));
}

void check_triangle(const Mesh& mesh, std::size_t k, std::string_view subject) {
  const Vector3i& triangle = mesh.triangles[k];
  const int count = static_cast<int>(mesh.vertices_m.size());
  for (const int vertex : triangle) {
    require(vertex >= 0 && vertex < count, subject, "triangle ", k, " has vertex ", vertex,
            ", expected 0 to ", count - 1);
  }
  const Eigen::Matrix3d corner = corners(mesh, triangle);
  double longest = 0.0;
  for (int i = 0; i < 3; ++i) {
    longest = std::max(longest, (corner.col((i + 1) % 3) - corner.col(i)).norm());
  }
  require(doubled_area(corner).norm() > kNoArea * longest * longest, subject, "triangle ", k,
          " of vertices ", triangle.transpose(), " has no area");
}

// Every edge once in each direction.
void check_edges(const Mesh& mesh, std::string_view subject) {
  std::map<std::pair<int, int>, int> uses;
  for (const Vector3i& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) ++uses[{triangle(k), triangle((k + 1) % 3)}];
  }
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    const int partners = back == uses.end() ? 0 : back->second;
    require(count == 1 && partners == 1, subject, "the edge from vertex ", edge.first, " to ",
            edge.second, " is part of ", count, " triangles and the edge back of ", partners,
            ", expected one each: a closed surface, all triangles turned the same way");
  }
}

void check_volume(const Mesh& mesh, std::string_view subject) {
  const Bounds bounds = bounds_of(mesh, Pose{});
  const double volume = mass_properties(mesh).volume_m3;
  double area = 0.0;
  for (const Vector3i& triangle : mesh.triangles) {
    area += doubled_area(corners(mesh, triangle)).norm() / 2.0;
  }
  const double least = kFlat * area * (bounds.high - bounds.low).norm();
  require(volume > -least, subject, "the volume is ", volume,
          " m3, expected > 0: the mesh is inside out");
  require(volume > least, subject, "the mesh encloses no volume");
}

void check(const Mesh& mesh, std::string_view subject, bool closed) {
  check_points(subject, "vertex", mesh.vertices_m);
  require(!mesh.triangles.empty(), subject, "a mesh of no triangles, expected at least 1");
  for (std::size_t k = 0; k < mesh.triangles.size(); ++k) check_triangle(mesh, k, subject);
  if (!closed) return;
  check_edges(mesh, subject);
  check_volume(mesh, subject);
}

}  // namespace

void check_piece(const Piece& piece, std::string_view subject, bool closed) {
  std::visit([&](const auto& kind) { check(kind, subject, closed); }, piece);
}

}  // namespace conebench::dem
