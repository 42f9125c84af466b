#include "dem/mesh_touches.h"

#include <algorithm>

#include "dem/closest_points.h"
#include "dem/point_distance.h"

namespace conebench::dem {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// The corners of a placed triangle that are farthest along a direction, as bits.
int top_corners(const Placed& triangle, const Vector3d& direction) {
  const double top = direction.dot(triangle.support(direction));
  const double size = std::max((triangle.points[1] - triangle.points[0]).norm(),
                               (triangle.points[2] - triangle.points[0]).norm());
  int corners = 0;
  for (int k = 0; k < 3; ++k) {
    const double height = direction.dot(triangle.points[static_cast<std::size_t>(k)]);
    if (top - height <= 1e-6 * size) corners |= 1 << k;
  }
  return corners;
}

}  // namespace

MeshTouches::MeshTouches() : triangle_(make_triangle()) {}

// In the directions of the mesh, about the middle of the convex piece.
void MeshTouches::add(const Convex& first, const Pose& first_pose, const SurfaceMesh& mesh,
                      const Pose& mesh_pose, double reach, std::vector<Touch>& out) {
  const Matrix3d turn = mesh_pose.orientation.toRotationMatrix();
  const Vector3d from_mesh =
      (first_pose.position - mesh_pose.position) + first_pose.orientation * first.centre;
  const Vector3d centre = turn.transpose() * from_mesh;
  const double unit = first.extent;
  first_.place(first, Vector3d::Zero(),
               turn.transpose() * first_pose.orientation.toRotationMatrix(), unit);
  find_about(mesh, centre, unit, reach);
  const std::size_t begin = out.size();
  std::optional<Touch> deepest;
  for (const int t : found_) {
    place_triangle(mesh, t, centre, unit);
    add_triangle(mesh, t, reach / unit, deepest, out);
  }
  if (out.size() == begin && deepest) out.push_back(*deepest);
  merge_touches(out, begin, Manifold::kSame);
  const Vector3d origin = first_pose * first.centre;
  for (std::size_t k = begin; k < out.size(); ++k) {
    out[k].point = origin + turn * (unit * out[k].point);
    out[k].normal = turn * out[k].normal;
    out[k].gap *= unit;
  }
}

void MeshTouches::add_ball(const Vector3d& centre, double radius, const SurfaceMesh& mesh,
                           const Pose& mesh_pose, double reach, std::vector<Touch>& out) {
  const Matrix3d turn = mesh_pose.orientation.toRotationMatrix();
  const Vector3d local = turn.transpose() * (centre - mesh_pose.position);
  const Vector3d half = Vector3d::Constant(radius + reach);
  mesh.find({local - half, local + half}, found_);
  const std::size_t begin = out.size();
  for (const int t : found_) {
    const TrianglePoint near =
        nearest_in_triangle(local, mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
    const double distance = (local - near.nearest).norm(), gap = distance - radius;
    if (!(gap < reach)) continue;
    Vector3d normal = mesh.normal(t);
    if (near.corners == 7) {
      if (normal.dot(local - near.nearest) < 0.0) normal = -normal;
    } else if (distance > 0.0) {
      normal = (local - near.nearest) / distance;
    }
    if (!mesh.supports(t, near.corners, normal)) continue;
    normal = turn * normal;
    out.push_back({centre - (radius + 0.5 * gap) * normal, normal, gap});
  }
  merge_touches(out, begin, Manifold::kSame * radius);
}

void MeshTouches::find_about(const SurfaceMesh& mesh, const Vector3d& centre, double unit,
                             double reach) {
  Bounds bounds{centre, centre};
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d up = Vector3d::Unit(axis);
    bounds.high(axis) += unit * (first_.support(up)(axis) + first_.radius) + reach;
    bounds.low(axis) += unit * (first_.support(-up)(axis) - first_.radius) - reach;
  }
  mesh.find(bounds, found_);
}

void MeshTouches::place_triangle(const SurfaceMesh& mesh, int t, const Vector3d& centre,
                                 double unit) {
  second_.place(triangle_, Vector3d::Zero(), Matrix3d::Identity(), unit);
  for (int k = 0; k < 3; ++k) {
    second_.points[static_cast<std::size_t>(k)] = (mesh.corner(t, k) - centre) / unit;
  }
  second_.centre = (second_.points[0] + second_.points[1] + second_.points[2]) / 3.0;
  second_.normals[0] = mesh.normal(t);
  second_.normals[1] = -mesh.normal(t);
}

// Of the placed piece with the placed triangle. What is nearest to a neighbour is its affair; the
// triangle then still carries what stands on it. `overlap`: of all triangles that the piece
// overlaps the touch with the plane that it is least below, for what is below a valley and stands
// on neither side.
void MeshTouches::add_triangle(const SurfaceMesh& mesh, int t, double reach,
                               std::optional<Touch>& overlap, std::vector<Touch>& out) {
  const ClosestPoints closest = closest_points(first_, second_);
  if (!(closest.distance - first_.radius < reach)) return;
  const double above = separation(first_, second_, mesh.normal(t));
  const double below = separation(first_, second_, -mesh.normal(t));
  const double side = above < below ? -1.0 : 1.0;
  const FacingFace face{false, side > 0.0 ? 0 : 1, side * mesh.normal(t)};
  const Inner inner = mesh.inner(t, side);
  if ((closest.normal - face.normal).norm() < Manifold::kFacing) {
    manifold_.add_along(first_, second_, face, reach, &inner, out);
  } else if (mesh.supports(t, top_corners(second_, closest.normal), closest.normal)) {
    manifold_.add(first_, second_, closest, reach, &inner, out);
  } else if (separates_best(mesh, t, side)) {
    manifold_.add_along(first_, second_, face, reach, &inner, out);
  }
  const double gap = std::max(above, below) - first_.radius;
  if (closest.distance - first_.radius < 0.0 && !(overlap && overlap->gap >= gap)) {
    const Vector3d lowest = first_.support(-face.normal) - first_.radius * face.normal;
    overlap = {lowest - 0.5 * gap * face.normal, face.normal, gap};
  }
}

// Whether the triangle's normal separates the two no worse than what is beyond its sharp sides:
// of a wall under a body that stands on its top, the top's normal does.
bool MeshTouches::separates_best(const SurfaceMesh& mesh, int t, double side) {
  const double own = separation(first_, second_, side * mesh.normal(t));
  mesh.normals_across_sharp_sides(t, normals_);
  return std::none_of(normals_.begin(), normals_.end(), [&](const Vector3d& normal) {
    return separation(first_, second_, side * normal) > own;
  });
}

}  // namespace conebench::dem
