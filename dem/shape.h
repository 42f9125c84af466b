#pragma once

#include <Eigen/Geometry>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace conebench::dem {

/// A rigid displacement: x -> orientation x + position.
struct Pose {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();

  Eigen::Vector3d operator*(const Eigen::Vector3d& x) const { return orientation * x + position; }
  Pose operator*(const Pose& inner) const {
    return {*this * inner.position, orientation * inner.orientation};
  }
  Pose inverse() const {
    const Eigen::Quaterniond back = orientation.conjugate();
    return {-(back * position), back};
  }
};

/// The pieces that shapes are made of, each about the origin of its own frame. All convex but Mesh.
struct Ball {
  double radius_m = 0.0;
};
struct Box {
  Eigen::Vector3d half_m = Eigen::Vector3d::Zero();  ///< half of each side
};
/// All points within `radius_m` of a segment along z.
struct Capsule {
  double radius_m = 0.0;
  double half_length_m = 0.0;  ///< half of the segment
};
/// A flat-ended cylinder along z.
struct Cylinder {
  double radius_m = 0.0;
  double half_length_m = 0.0;
};
/// The convex hull of its points.
struct Hull {
  std::vector<Eigen::Vector3d> points_m;
};
/// A surface without mass, for bodies that are fixed or driven. Both sides of a triangle are solid.
struct Mesh {
  std::vector<Eigen::Vector3d> vertices_m;
  std::vector<Eigen::Vector3i> triangles;  ///< vertices, anticlockwise seen from outside
};
using Piece = std::variant<Ball, Box, Capsule, Cylinder, Hull, Mesh>;

struct Part {
  Piece piece;
  Pose pose;  ///< piece to shape
};

/// Parts that move as one.
struct Shape {
  std::string name;
  std::vector<Part> parts;

  bool has_mesh() const;
};

/// Of a solid of density 1 kg/m3.
struct MassProperties {
  double volume_m3 = 0.0;
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d inertia_m5 = Eigen::Matrix3d::Zero();  ///< about the centre
};

/// Exact for every piece; hulls and closed meshes by the tetrahedra over their triangles. Parts
/// that overlap count twice. A mesh inside out has a negative volume; of an open mesh the numbers
/// mean nothing. All zero where the volume is zero.
MassProperties mass_properties(const Piece& piece);
MassProperties mass_properties(const Shape& shape);

/// The axes along which `inertia` is diagonal, a right-handed frame that is the same on every
/// machine, as near to identity as can be: identity itself, with the moments in the order x, y, z,
/// where `inertia` is diagonal already. Moments that differ by less than 1e-9 of the largest are
/// taken as equal: what is left beside the diagonal is then of that size.
struct PrincipalAxes {
  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();  ///< columns
  Eigen::Vector3d moments = Eigen::Vector3d::Zero();   ///< along them
};
PrincipalAxes principal_axes(const Eigen::Matrix3d& inertia);

/// The triangles of the hull of a set of points, anticlockwise seen from outside, by indices of
/// points. No point lies farther than 1e-12 of their extent outside of a triangle; points inside,
/// in a face, in an edge or equal to another one (within 1e-13 of the extent) are not referred to.
/// Empty where the points lie in a plane (thinner than 1e-9 of their extent).
///
/// Cost    points x triangles.
/// Method  Points are taken in one at a time, farthest first, as in quickhull (Barber, Dobkin,
///         Huhdanpaa, ACM TOMS 22(4), 1996; not checked), with exact signs: see orientation.h.
///         Bullet's btConvexHullComputer would not do: it rounds coordinates to 1e-4 of the extent.
std::vector<Eigen::Vector3i> hull_triangles(const std::vector<Eigen::Vector3d>& points);

/// The smallest axis-aligned box about a piece at a pose. Precondition: check_piece() accepts it.
struct Bounds {
  Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();
};
Bounds bounds_of(const Piece& piece, const Pose& pose);

/// Faces for pictures: flat polygons, anticlockwise seen from outside. Round surfaces are replaced
/// by facets with their corners on them, `around` (>= 3) along a circle about z and about as many
/// along one through the poles. Precondition: check_piece() accepts the piece.
struct Polyhedron {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::vector<int>> faces;
};
Polyhedron facets(const Piece& piece, int around);

/// Throws InputError naming `subject` where a piece cannot be: a size that is not positive and
/// finite, a point that is not finite, a hull without volume, a mesh without triangles, a triangle
/// without area or with an index out of range, and, where a mesh has to be `closed`, edges that do
/// not meet in pairs or a volume that is not positive (inside out, or flat).
void check_piece(const Piece& piece, std::string_view subject, bool closed = false);

}  // namespace conebench::dem
