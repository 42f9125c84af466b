#include "dem/gjk.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace conebench::dem {
namespace {

using Eigen::Vector3d;

constexpr double kRounding = 1e-14;
constexpr int kMaxIterations = 500;

// A point of the difference of two cores.
struct Corner {
  Vector3d on_first, on_second, difference;
};

class Simplex {
 public:
  const Vector3d& nearest() const { return nearest_; }
  double size() const { return size_; }

  NearestPoints points() const {
    NearestPoints points;
    for (int k = 0; k < count_; ++k) {
      points.on_first += weight_[at(k)] * corner_[at(k)].on_first;
      points.on_second += weight_[at(k)] * corner_[at(k)].on_second;
    }
    return points;
  }

  // Takes in a corner and drops those that are of no use. False where nothing came nearer.
  bool improve(const Corner& corner) {
    const double before = count_ == 0 ? std::numeric_limits<double>::infinity() : least_;
    const Simplex old = *this;
    size_ = std::max(size_, corner.difference.norm());
    corner_[at(count_++)] = corner;
    least_ = std::numeric_limits<double>::infinity();
    for (int i = 0; i < count_; ++i) look_at(i);
    for (int i = 0; i < count_; ++i) {
      for (int j = i + 1; j < count_; ++j) look_at(i, j);
    }
    for (int i = 0; i < count_; ++i) {
      for (int j = i + 1; j < count_; ++j) {
        for (int k = j + 1; k < count_; ++k) look_at(i, j, k);
      }
    }
    if (count_ == 4 && holds_origin()) least_ = 0.0;
    if (!(least_ < before)) {
      *this = old;
      return false;
    }
    keep_best();
    return true;
  }

  bool overlaps() const { return least_ <= kRounding * kRounding * size_ * size_; }

 private:
  static std::size_t at(int k) { return static_cast<std::size_t>(k); }
  const Vector3d& x(int k) const { return corner_[at(k)].difference; }

  void offer(const Vector3d& point, std::array<int, 3> corners, std::array<double, 3> weights,
             int count) {
    const double here = point.squaredNorm();
    if (!(here < least_)) return;
    least_ = here;
    nearest_ = point;
    best_ = corners;
    best_weight_ = weights;
    best_count_ = count;
  }

  void look_at(int i) { offer(x(i), {i}, {1.0}, 1); }

  void look_at(int i, int j) {
    const Vector3d side = x(j) - x(i);
    const double t = -x(i).dot(side) / side.squaredNorm();
    if (t > 0.0 && t < 1.0) offer(x(i) + t * side, {i, j}, {1.0 - t, t}, 2);
  }

  void look_at(int i, int j, int k) {
    const Vector3d normal = (x(j) - x(i)).cross(x(k) - x(i));
    const double square = normal.squaredNorm();
    const double a = normal.dot(x(j).cross(x(k))) / square;
    const double b = normal.dot(x(k).cross(x(i))) / square;
    const double c = 1.0 - a - b;
    if (a > 0.0 && b > 0.0 && c > 0.0) {
      offer(normal * (normal.dot(x(i)) / square), {i, j, k}, {a, b, c}, 3);
    }
  }

  // Whether the origin is on the same side of each face as the corner across; never so of a simplex
  // that is flat to rounding.
  bool holds_origin() const {
    for (int k = 0; k < 4; ++k) {
      const Vector3d &a = x(k), &b = x((k + 1) % 4), &c = x((k + 2) % 4), &d = x((k + 3) % 4);
      const Vector3d normal = (b - a).cross(c - a);
      const double corner = normal.dot(d - a), origin = -normal.dot(a);
      if (std::abs(corner) <= kRounding * size_ * normal.norm()) return false;
      if (corner * origin <= 0.0) return false;
    }
    return true;
  }

  void keep_best() {
    if (least_ == 0.0) return;
    std::array<Corner, 3> kept;
    for (int k = 0; k < best_count_; ++k) kept[at(k)] = corner_[at(best_[at(k)])];
    std::copy_n(kept.begin(), best_count_, corner_.begin());
    weight_ = best_weight_;
    count_ = best_count_;
  }

  std::array<Corner, 4> corner_;
  std::array<double, 3> weight_{}, best_weight_{};
  std::array<int, 3> best_{};
  Vector3d nearest_ = Vector3d::Zero();
  double least_ = 0.0;  // squared distance
  double size_ = 0.0;
  int count_ = 0, best_count_ = 0;
};

}  // namespace

std::optional<NearestPoints> nearest_points(const Placed& first, const Placed& second,
                                            const Vector3d& shift) {
  const auto support = [&](const Vector3d& direction) {
    const Vector3d a = first.support(-direction) + shift, b = second.support(direction);
    return Corner{a, b, a - b};
  };
  const Vector3d apart = first.centre + shift - second.centre;
  Simplex simplex;
  simplex.improve(support(apart.isZero() ? Vector3d(Vector3d::UnitX()) : apart));
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    if (simplex.overlaps()) return std::nullopt;
    const Vector3d& nearest = simplex.nearest();
    const Corner corner = support(nearest);
    const double upper = nearest.norm(), lower = nearest.dot(corner.difference) / upper;
    if (upper - lower <= kRounding * upper || !simplex.improve(corner)) break;
  }
  return simplex.points();
}

}  // namespace conebench::dem
