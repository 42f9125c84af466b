#include "dem/closest_points.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "dem/gjk.h"
#include "dem/refine_normal.h"

namespace conebench::dem {
namespace {

using Eigen::Vector3d;

constexpr double kTouching = 1e-8;  // nearer than this, the difference of two points has no digits
constexpr double kClear = 1e-2;    // gap at which the closest points of moved pieces are looked for
constexpr double kClosest = 1e-6;  // least such gap
constexpr double kBetter = 1e-12;  // least gain of a step towards the least overlap
constexpr double kPreferFace = 1e-10;
constexpr int kMaxSteps = 100;

// The closest points with the first moved by `shift`; none where the two then overlap.
std::optional<ClosestPoints> gjk(const Placed& first, const Placed& second, const Vector3d& shift) {
  const auto nearest = nearest_points(first, second, shift);
  if (!nearest) return std::nullopt;
  const auto& [on_first, on_second] = *nearest;
  const double distance = (on_first - on_second).norm();
  if (!(distance > kTouching)) return std::nullopt;
  return ClosestPoints{(on_first - on_second) / distance, distance, on_first - shift, on_second};
}

// The normal among some that separates two pieces best.
class BestNormal {
 public:
  BestNormal(const Placed& first, const Placed& second) : first_(first), second_(second) {}

  void offer(const Vector3d& normal, double handicap = 0.0) {
    const double here = separation(first_, second_, normal);
    if (offered_ && !(here > best_ + handicap)) return;
    best_ = here;
    normal_ = normal;
    offered_ = true;
  }
  const Vector3d& normal() const { return normal_; }

 private:
  const Placed& first_;
  const Placed& second_;
  Vector3d normal_ = Vector3d::UnitZ();
  double best_ = 0.0;
  bool offered_ = false;
};

// Whether the outward normals where an edge meets another's direction go with the sign: the great
// arc from the normal on its left to that on its right crosses the one normal to `other`.
bool arc_crosses(const Placed& placed, const Convex::Edge& edge, const Vector3d& other,
                 double sign) {
  if (edge.left < 0) return true;
  const double left = sign * placed.normals[static_cast<std::size_t>(edge.left)].dot(other);
  const double right = sign * placed.normals[static_cast<std::size_t>(edge.right)].dot(other);
  const double rounding = 1e-12 * other.norm();
  return left >= -rounding && right <= rounding;
}

void offer_edge_pairs(const Placed& first, const Placed& second, BestNormal& best) {
  for (const Convex::Edge& a : first.convex->edges) {
    const Vector3d along_a = first.along(a);
    for (const Convex::Edge& b : second.convex->edges) {
      const Vector3d along_b = second.along(b);
      for (const double sign : {1.0, -1.0}) {
        // Outwards of the first along sign (a x b), of the second against it.
        if (!arc_crosses(first, a, along_b, sign) || !arc_crosses(second, b, along_a, sign)) {
          continue;
        }
        const Vector3d normal = -sign * along_a.cross(along_b);
        const double length = normal.norm();
        if (length <= 1e-12 * along_a.norm() * along_b.norm()) continue;
        best.offer(normal / length, kPreferFace);
      }
    }
  }
}

// Square to a segment, from one centre to the other.
void offer_square_to(const Placed& placed, const Vector3d& apart, BestNormal& best) {
  for (const Convex::Edge& edge : placed.convex->edges) {
    if (edge.left >= 0) continue;
    const Vector3d along = placed.along(edge).normalized();
    const Vector3d square = apart - along * along.dot(apart);
    best.offer(square.norm() > kTouching ? square.normalized() : along.unitOrthogonal(),
               kPreferFace);
  }
}

Vector3d least_overlap_normal(const Placed& first, const Placed& second) {
  BestNormal best(first, second);
  for (const Vector3d& normal : second.normals) best.offer(normal);
  for (const Vector3d& normal : first.normals) best.offer(-normal, kPreferFace);
  offer_edge_pairs(first, second, best);
  offer_square_to(first, first.centre - second.centre, best);
  offer_square_to(second, first.centre - second.centre, best);
  return best.normal();
}

// From a normal to one that no step improves. A gap like the overlap makes the steps long.
ClosestPoints climb(const Placed& first, const Placed& second, const Vector3d& start) {
  ClosestPoints best{start, separation(first, second, start), first.support(-start),
                     second.support(start)};
  double gap = kClear;
  for (int step = 0; step < kMaxSteps; ++step) {
    const auto clear = gjk(first, second, (gap - best.distance) * best.normal);
    if (!clear) break;
    const double here = separation(first, second, clear->normal);
    if (here > best.distance + kBetter) {
      best = {clear->normal, here, clear->on_first, clear->on_second};
      continue;
    }
    if (gap == kClear) {
      best.on_first = clear->on_first;
      best.on_second = clear->on_second;
    }
    if (gap <= std::max(std::abs(best.distance), kClosest)) break;
    gap *= 0.1;
  }
  return best;
}

// The normal where the way out from the second's centre leaves: near the best where the overlap is
// slight.
Vector3d way_out_normal(const Placed& first, const Placed& second) {
  const Vector3d apart = first.centre - second.centre;
  const Vector3d way = apart.isZero() ? Vector3d(Vector3d::UnitZ()) : apart.normalized();
  for (double length = kClear; length < 1e6; length *= 2.0) {
    if (const auto clear = gjk(first, second, length * way)) return clear->normal;
  }
  return way;
}

}  // namespace

double separation(const Placed& first, const Placed& second, const Vector3d& normal) {
  return normal.dot(first.support(-normal) - second.support(normal));
}

ClosestPoints closest_points(const Placed& first, const Placed& second) {
  const bool discs = first.disc > 0.0 || second.disc > 0.0;
  const auto apart = gjk(first, second, Vector3d::Zero());
  if (apart && !discs) return *apart;
  ClosestPoints best;
  if (apart && apart->distance > kClear) {
    best = *apart;
  } else {
    best = climb(first, second, least_overlap_normal(first, second));
  }
  if (!discs) return best;
  refine_normal(first, second, best);
  if (apart && apart->distance > kClear) return best;
  ClosestPoints other = climb(first, second, way_out_normal(first, second));
  refine_normal(first, second, other);
  if (other.distance > best.distance + kPreferFace) best = other;
  if (apart) {
    other = *apart;
    refine_normal(first, second, other);
    if (other.distance > best.distance + kPreferFace) best = other;
  }
  return best;
}

}  // namespace conebench::dem
