#pragma once

#include <Eigen/Core>
#include <vector>

#include "dem/shape.h"

namespace conebench::dem {

/// A convex piece made ready for the narrow phase: all points within `radius` of a core, which is
/// the hull of `points`; a cylinder's core is the hull of two discs of radius `disc` about its two
/// points, normal to the line between them. About `centre`, in the piece's frame. [m]
struct Convex {
  /// Flat, anticlockwise seen from outside; of a disc its centre alone.
  struct Face {
    Eigen::Vector3d normal;  ///< outwards, unit length
    std::vector<int> corners;
  };
  /// With the faces on both sides, seen from outside along the edge; -1 where there are none.
  struct Edge {
    int from = 0, to = 0;
    int left = -1, right = -1;
  };

  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  std::vector<Eigen::Vector3d> points;  ///< from the centre
  std::vector<Face> faces;
  std::vector<Edge> edges;
  double radius = 0.0;
  double disc = 0.0;
  double extent = 0.0;  ///< of the ball about the centre that holds the piece

  bool round() const { return radius > 0.0 || disc > 0.0; }
};

/// Of any piece but a Mesh. Triangles of a hull that lie in a plane (to 1e-9 of its extent) become
/// one face.
Convex make_convex(const Piece& piece);

/// The two faces and three edges of a triangle whose corners are at the origin.
Convex make_triangle();

/// A convex piece where it is, in a frame near to it and in a unit of length near to its size: the
/// tolerances of what is done with it are absolute.
struct Placed {
  const Convex* convex = nullptr;
  std::vector<Eigen::Vector3d> points;
  std::vector<Eigen::Vector3d> normals;  ///< of the faces
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();  ///< of the piece's directions
  double radius = 0.0;
  double disc = 0.0;

  Eigen::Vector3d axis() const { return rotation.col(2); }  ///< normal of the discs

  /// `position`: of the centre, in the frame and the unit.
  void place(const Convex& what, const Eigen::Vector3d& position, const Eigen::Matrix3d& turn,
             double unit_m);

  /// The index of the point farthest along a direction.
  int farthest(const Eigen::Vector3d& direction) const;

  /// From the middle of a disc to its rim along a direction; zero where the direction is the axis,
  /// and without discs.
  Eigen::Vector3d to_rim(const Eigen::Vector3d& direction) const;

  /// The point of the core farthest along a direction.
  Eigen::Vector3d support(const Eigen::Vector3d& direction) const {
    return points[static_cast<std::size_t>(farthest(direction))] + to_rim(direction);
  }

  /// From one end of an edge to the other.
  Eigen::Vector3d along(const Convex::Edge& edge) const {
    return points[static_cast<std::size_t>(edge.to)] - points[static_cast<std::size_t>(edge.from)];
  }
};

}  // namespace conebench::dem
