#include "dem/motion.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace conebench::dem {
namespace {

using Eigen::AngleAxisd;
using Eigen::Quaterniond;
using Eigen::Vector3d;

// A motion at one time: x -> point + shift + orientation (x - point).
struct Placement {
  Vector3d point = Vector3d::Zero();
  Vector3d shift = Vector3d::Zero();
  Quaterniond orientation = Quaterniond::Identity();
};

template <class Timed>
double elapsed(const Timed& motion, double t_s) {
  return std::max(0.0, std::min(t_s, motion.until_s) - motion.from_s);
}

Placement placement(const Slide& slide, double t_s) {
  return {.shift = elapsed(slide, t_s) * slide.velocity_m_s};
}

Placement placement(const Turn& turn, double t_s) {
  const AngleAxisd turned(elapsed(turn, t_s) * turn.rate_rad_s, turn.axis);
  return {.point = turn.point_m, .orientation = Quaterniond(turned)};
}

Placement placement(const Shake& shake, double t_s) {
  const double periods = shake.frequency_Hz * elapsed(shake, t_s);
  const double phase = 2.0 * std::numbers::pi * (periods - std::round(periods));
  return {.shift = std::sin(phase) * shake.amplitude_m};
}

Placement placement(const Table& table, double t_s) {
  const auto next = std::upper_bound(table.t_s.begin(), table.t_s.end(), t_s);
  const auto k = static_cast<std::size_t>(next - table.t_s.begin());
  if (next == table.t_s.begin() || next == table.t_s.end()) {
    const Pose& end = k == 0 ? table.poses.front() : table.poses.back();
    return {table.point_m, end.position, end.orientation};
  }
  const Pose& a = table.poses[k - 1];
  const Pose& b = table.poses[k];
  const double share = (t_s - table.t_s[k - 1]) / (table.t_s[k] - table.t_s[k - 1]);
  return {table.point_m, (1.0 - share) * a.position + share * b.position,
          a.orientation.slerp(share, b.orientation)};
}

// The shortest rotation vector from one orientation to another; without rounding where they agree.
Vector3d turn_between(const Quaterniond& from, const Quaterniond& to) {
  if (from.coeffs() == to.coeffs()) return Vector3d::Zero();
  const AngleAxisd turn(to * from.conjugate());
  return turn.angle() * turn.axis();
}

template <class Kind>
Vector3d turn_within(const Kind& kind, double from_s, double to_s) {
  return turn_between(placement(kind, from_s).orientation, placement(kind, to_s).orientation);
}

// Any number of turns, and no rounding from the difference of two orientations.
Vector3d turn_within(const Turn& turn, double from_s, double to_s) {
  return (elapsed(turn, to_s) - elapsed(turn, from_s)) * turn.rate_rad_s * turn.axis;
}

// exp(turn) arm - arm by Rodrigues' formula, which loses no digits when the turn is small.
Vector3d swing(const Vector3d& turn, const Vector3d& arm) {
  const double angle = turn.norm();
  if (angle == 0.0) return Vector3d::Zero();
  const Vector3d across = (turn / angle).cross(arm);
  const double half_sine = std::sin(0.5 * angle);
  return std::sin(angle) * across + 2.0 * half_sine * half_sine * (turn / angle).cross(across);
}

}  // namespace

Pose Motion::displacement(double t_s) const {
  const auto [point, shift, orientation] =
      std::visit([&](const auto& k) { return placement(k, t_s); }, kind);
  return {shift + (point - orientation * point), orientation};
}

Twist mean_twist(const Motion& motion, double t_s, double h_s, const Eigen::Vector3d& about_m) {
  return std::visit(
      [&](const auto& kind) -> Twist {
        const Placement start = placement(kind, t_s);
        const Vector3d shift = placement(kind, t_s + h_s).shift - start.shift;
        const Vector3d turn = turn_within(kind, t_s, t_s + h_s);
        const Vector3d arm = about_m - (start.point + start.shift);
        return {(shift + swing(turn, arm)) / h_s, turn / h_s, about_m};
      },
      motion.kind);
}

}  // namespace conebench::dem
