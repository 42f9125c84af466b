#include "dem/parallel_sides.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <optional>

namespace conebench::dem {
namespace {

using Eigen::Vector3d;

constexpr double kRound = 0.1;  // sines of angles
constexpr double kSharp = 1e-6;
constexpr double kBeyond = 1e-9;  // of a side's length: an end no farther beyond is at the end
constexpr double kSameWay = 0.9;  // least cosine between the normal at an end and the common one

using Side = std::array<Vector3d, 2>;

std::optional<Side> square_side(const Placed& placed, const Vector3d& outward, double tolerance) {
  const int top = placed.farthest(outward);
  std::optional<Side> best;
  double least = tolerance;
  for (const Convex::Edge& edge : placed.convex->edges) {
    if (edge.from != top && edge.to != top) continue;
    const double off = std::abs(placed.along(edge).normalized().dot(outward));
    if (off > least) continue;
    least = off;
    best = {placed.points[static_cast<std::size_t>(edge.from)],
            placed.points[static_cast<std::size_t>(edge.to)]};
  }
  return best;
}

// The touch at one end of a side of `own`, if the other's side is there. The normal is towards
// `own`.
std::optional<Touch> touch_at_end(const Placed& own, const Vector3d& end, const Placed& other,
                                  const Side& side, const Vector3d& normal) {
  const Vector3d along = side[1] - side[0];
  const auto share = [&](const Vector3d& x) {
    return along.dot(x - side[0]) / along.squaredNorm();
  };
  const Vector3d above = side[0] + along * share(end);
  const Vector3d on_own = end + own.to_rim(above - end);
  const double place = share(on_own);
  if (place < -kBeyond || place > 1.0 + kBeyond) return std::nullopt;
  const Vector3d on_side = side[0] + along * place;
  const Vector3d way = on_own - on_side;
  const double radius = other.radius + other.disc;
  const bool round = own.radius + radius > 0.0 && normal.dot(way) > kSameWay * way.norm();
  const Vector3d own_normal = round ? Vector3d(way.normalized()) : normal;
  const Vector3d low = on_side + radius * own_normal, high = on_own - own.radius * own_normal;
  return Touch{0.5 * (low + high), own_normal, own_normal.dot(high - low)};
}

}  // namespace

void add_parallel_sides(const Placed& first, const Placed& second, const Vector3d& normal,
                        double reach, std::vector<Touch>& out) {
  const double tolerance = first.convex->round() && second.convex->round() ? kRound : kSharp;
  const auto a = square_side(first, -normal, tolerance);
  const auto b = square_side(second, normal, tolerance);
  if (!a || !b) return;
  const Vector3d along_a = ((*a)[1] - (*a)[0]).normalized();
  const Vector3d along_b = ((*b)[1] - (*b)[0]).normalized();
  if (along_a.cross(along_b).norm() > tolerance) return;
  for (const Vector3d& end : *a) {
    const auto touch = touch_at_end(first, end, second, *b, normal);
    if (touch && touch->gap < reach) out.push_back(*touch);
  }
  for (const Vector3d& end : *b) {
    auto touch = touch_at_end(second, end, first, *a, -normal);
    if (!touch || !(touch->gap < reach)) continue;
    touch->normal = -touch->normal;
    out.push_back(*touch);
  }
}

}  // namespace conebench::dem
