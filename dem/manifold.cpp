#include "dem/manifold.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "dem/parallel_sides.h"

namespace conebench::dem {
namespace {

using Eigen::Vector3d;

// The face that is nearest to square to the normal; the second's if both are.
std::optional<FacingFace> facing_face(const Placed& first, const Placed& second,
                                      const Vector3d& normal) {
  std::optional<FacingFace> best;
  double least = Manifold::kFacing;
  const auto look = [&](const Placed& placed, bool of_first, double handicap) {
    for (std::size_t f = 0; f < placed.normals.size(); ++f) {
      const Vector3d here = of_first ? Vector3d(-placed.normals[f]) : placed.normals[f];
      const double off = (here - normal).norm() + handicap;
      if (off >= least) continue;
      least = off;
      best = {of_first, static_cast<int>(f), here};
    }
  };
  look(second, false, 0.0);
  look(first, true, Manifold::kSame);
  return best;
}

Touch touch_between(const Vector3d& on_first, const Vector3d& on_second, const Vector3d& normal,
                    double gap) {
  return {0.5 * (on_first + on_second), normal, gap};
}

}  // namespace

void Manifold::add_along(const Placed& first, const Placed& second, const FacingFace& facing,
                         double reach, const Inner* inner_of_second, std::vector<Touch>& out) {
  const Vector3d& normal = facing.normal;
  Eigen::Matrix3d frame;
  frame.col(0) = normal.unitOrthogonal();
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  const Vector3d apart = second.centre - first.centre;
  const bool discs = first.disc > 0.0 && second.disc > 0.0;
  const Vector3d towards = discs ? apart : Vector3d(Vector3d::Zero());
  set_outline(first, -normal, facing.of_first ? facing.face : -1, towards, nullptr, frame, first_);
  set_outline(second, normal, facing.of_first ? -1 : facing.face, -towards, inner_of_second, frame,
              second_);
  shared_.clear();
  shared_points(first_, second_, kSame, shared_);
  for (const SharedPoint& shared : shared_) {
    const double low = shared.second + second.radius, high = shared.first - first.radius;
    if (!(high - low < reach)) continue;
    const Vector3d middle(shared.at.x(), shared.at.y(), 0.5 * (low + high));
    out.push_back({frame * middle, normal, high - low});
  }
}

void Manifold::add(const Placed& first, const Placed& second, const ClosestPoints& closest,
                   double reach, const Inner* inner_of_second, std::vector<Touch>& out) {
  const double gap = closest.distance - first.radius - second.radius;
  if (!(gap < reach)) return;
  const std::size_t begin = out.size();
  const auto facing = facing_face(first, second, closest.normal);
  if (facing) {
    add_along(first, second, *facing, reach, inner_of_second, out);
  } else {
    add_parallel_sides(first, second, closest.normal, reach, out);
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = begin; k < out.size(); ++k) least = std::min(least, out[k].gap);
  // In overlap, the deepest point of a face's other may lie beyond the face.
  const bool beyond = facing && closest.distance <= 0.0 && out.size() > begin;
  if (!beyond && gap < least - kSame - kFacing * kFacing * std::abs(gap)) {
    const Vector3d normal = facing ? facing->normal : closest.normal;
    out.push_back(touch_between(closest.on_first - first.radius * normal,
                                closest.on_second + second.radius * normal, normal, gap));
  }
  merge_touches(out, begin, kSame);
}

void merge_touches(std::vector<Touch>& touches, std::size_t begin, double tolerance) {
  std::size_t kept = begin;
  for (std::size_t k = begin; k < touches.size(); ++k) {
    const auto same = [&](const Touch& touch) {
      return (touch.point - touches[k].point).norm() <= tolerance;
    };
    const auto start = touches.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto end = touches.begin() + static_cast<std::ptrdiff_t>(kept);
    const auto before = std::find_if(start, end, same);
    if (before == end) {
      touches[kept++] = touches[k];
    } else if (touches[k].gap < before->gap) {
      *before = touches[k];
    }
  }
  touches.resize(kept);
}

}  // namespace conebench::dem
