#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "dem/narrow_phase.h"

namespace conebench::dem::test {

/// Random pieces and poses, the same for the same seed.
class Random {
 public:
  explicit Random(unsigned seed) : engine_(seed) {}

  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  Eigen::Vector3d vector() {
    std::normal_distribution<double> normal;
    return {normal(engine_), normal(engine_), normal(engine_)};
  }
  Eigen::Vector3d direction() { return vector().normalized(); }
  Eigen::Quaterniond turn() {
    std::normal_distribution<double> normal;
    return Eigen::Quaterniond(normal(engine_), normal(engine_), normal(engine_), normal(engine_))
        .normalized();
  }

  Box box() { return {{size(), size(), size()}}; }
  Capsule capsule() { return {0.3 * size(), size()}; }
  Cylinder cylinder() { return {size(), size()}; }
  Hull hull() {
    Hull hull;
    const int count = static_cast<int>(uniform(5.0, 25.0));
    for (int k = 0; k < count; ++k) hull.points_m.push_back(0.5 * vector());
    return hull;
  }
  /// Box, capsule, cylinder or hull.
  Piece piece(int kind) {
    if (kind == 0) return box();
    if (kind == 1) return capsule();
    if (kind == 2) return cylinder();
    return hull();
  }

 private:
  double size() { return uniform(0.2, 1.2); }

  std::mt19937 engine_;
};

inline Pose at(const Eigen::Vector3d& position,
               const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity()) {
  return {position, turn};
}

inline Eigen::Quaterniond turned(double angle_rad, const Eigen::Vector3d& axis) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, axis));
}

/// Two pieces, prepared once.
class PiecePair {
 public:
  PiecePair(const Piece& first, const Piece& second) : narrow_(std::vector<Piece>{first, second}) {}

  std::vector<Touch> touches(const Pose& first_pose, const Pose& second_pose, double reach) {
    std::vector<Touch> found;
    narrow_.touches(0, first_pose, 1, second_pose, reach, found);
    return found;
  }

 private:
  NarrowPhase narrow_;
};

/// The touches of two pieces.
inline std::vector<Touch> touches_of(const Piece& first, const Pose& first_pose,
                                     const Piece& second, const Pose& second_pose, double reach) {
  return PiecePair(first, second).touches(first_pose, second_pose, reach);
}

/// The touch with the least gap.
inline Touch nearest(const std::vector<Touch>& touches) {
  return *std::min_element(touches.begin(), touches.end(),
                           [](const Touch& a, const Touch& b) { return a.gap < b.gap; });
}

/// Whether there is a touch at a place, with a gap and a normal, all to 1e-9.
inline bool has(const std::vector<Touch>& touches, const Eigen::Vector3d& point,
                const Eigen::Vector3d& normal, double gap) {
  return std::any_of(touches.begin(), touches.end(), [&](const Touch& touch) {
    return (touch.point - point).norm() < 1e-9 && (touch.normal - normal).norm() < 1e-9 &&
           std::abs(touch.gap - gap) < 1e-9;
  });
}

}  // namespace conebench::dem::test
