#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "dem/orientation.h"
#include "dem/shape.h"

namespace conebench::dem {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3i;
using Points = std::vector<Vector3d>;

// Of the extent: points no farther than this above a face count as in it; well above rounding.
constexpr double kInFace = 1e-13;
constexpr double kFlat = 1e-9;

struct Face {
  Vector3i corners;
  int next = -1;  // the point to take in for it, -1 where none lies above
};

// The hull of some of the points, to which others are added one at a time. Which faces a point
// sees is decided exactly, so that what is held is a convex polyhedron at any time.
class GrowingHull {
 public:
  explicit GrowingHull(const Points& points) : points_(points) {
    if (!points.empty()) start();
    while (!faces_.empty()) {
      const auto face =
          std::find_if(faces_.begin(), faces_.end(), [](const Face& f) { return f.next >= 0; });
      if (face == faces_.end()) break;
      take_in(face->next);
    }
  }

  std::vector<Vector3i> triangles() const {
    std::vector<Vector3i> triangles;
    for (const Face& face : faces_) triangles.push_back(face.corners);
    return triangles;
  }

 private:
  const Vector3d& at(int k) const { return points_[static_cast<std::size_t>(k)]; }

  bool sees(int point, const Vector3i& face) const {
    return orientation(at(face(0)), at(face(1)), at(face(2)), at(point)) > 0;
  }

  // The point that goes farthest by `measure`, -1 where none exceeds `least`. Of those at the
  // same distance but for rounding the one farthest from `from`: a corner of what they span,
  // never a point inside an edge or a face of it.
  template <class Measure>
  int farthest(const Vector3d& from, double least, const Measure& measure) const {
    const int count = static_cast<int>(points_.size());
    double most = 0.0;
    for (int k = 0; k < count; ++k) most = std::max(most, measure(at(k)));
    if (most <= least) return -1;
    int best = -1;
    for (int k = 0; k < count; ++k) {
      if (measure(at(k)) < most - kInFace * extent_) continue;
      if (best < 0 || (at(k) - from).norm() > (at(best) - from).norm()) best = k;
    }
    return best;
  }

  // Four points far apart; no face at all where the points lie in a plane.
  void start() {
    Vector3d middle = Vector3d::Zero();
    for (const Vector3d& point : points_) middle += point / static_cast<double>(points_.size());
    const int a = farthest(middle, -1.0, [&](const Vector3d& x) { return (x - middle).norm(); });
    const int b = farthest(at(a), 0.0, [&](const Vector3d& x) { return (x - at(a)).norm(); });
    if (b < 0) return;
    extent_ = (at(b) - at(a)).norm();

    const Vector3d along = (at(b) - at(a)) / extent_;
    const int c = farthest(at(a), kFlat * extent_,
                           [&](const Vector3d& x) { return along.cross(x - at(a)).norm(); });
    if (c < 0) return;
    const Vector3d normal = along.cross(at(c) - at(a)).normalized();
    const int d = farthest(at(a), kFlat * extent_,
                           [&](const Vector3d& x) { return std::abs(normal.dot(x - at(a))); });
    if (d < 0) return;

    const bool turned = sees(d, {a, b, c});
    const std::array<int, 4> corner = {a, turned ? c : b, turned ? b : c, d};
    add_face(corner[0], corner[1], corner[2]);
    add_face(corner[0], corner[2], corner[3]);
    add_face(corner[0], corner[3], corner[1]);
    add_face(corner[1], corner[3], corner[2]);
  }

  void add_face(int a, int b, int c) {
    Face face{{a, b, c}};
    const Vector3d normal = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
    face.next = farthest(at(a), kInFace * extent_,
                         [&](const Vector3d& x) { return normal.dot(x - at(a)); });
    if (face.next >= 0 && !sees(face.next, face.corners)) face.next = -1;
    faces_.push_back(face);
  }

  // Replaces the faces that the point sees by those that join it to their rim.
  void take_in(int point) {
    const auto seen = std::stable_partition(
        faces_.begin(), faces_.end(), [&](const Face& face) { return !sees(point, face.corners); });
    std::set<std::pair<int, int>> edges;
    for (auto face = seen; face != faces_.end(); ++face) {
      for (int k = 0; k < 3; ++k) edges.emplace(face->corners(k), face->corners((k + 1) % 3));
    }
    faces_.erase(seen, faces_.end());
    for (const auto& [from, to] : edges) {
      if (!edges.contains({to, from})) add_face(from, to, point);
    }
  }

  const Points& points_;
  double extent_ = 0.0;
  std::vector<Face> faces_;
};

}  // namespace

std::vector<Vector3i> hull_triangles(const Points& points) {
  return GrowingHull(points).triangles();
}

}  // namespace conebench::dem
