#include "dem/outline.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace conebench::dem {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Cosine of the steepest face whose heights still have digits.
constexpr double kSteep = 1e-3;
// Sine of the tilt below which all points of a disc are as high.
constexpr double kLevel = 1e-9;
// Sine of the tilt up to which two discs are looked at as circles.
constexpr double kCircles = 1e-4;

std::size_t at(int k) { return static_cast<std::size_t>(k); }

double cross(const Vector2d& a, const Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

int flattest_face_at_support(const Placed& placed, const Vector3d& outward) {
  const int top = placed.farthest(outward);
  int best = -1;
  double most = kSteep;
  for (std::size_t f = 0; f < placed.normals.size(); ++f) {
    const auto& corners = placed.convex->faces[f].corners;
    const double here = placed.normals[f].dot(outward);
    if (here <= most || std::find(corners.begin(), corners.end(), top) == corners.end()) continue;
    most = here;
    best = static_cast<int>(f);
  }
  return best;
}

void set_disc(const Placed& placed, const Vector3d& outward, const Vector3d& towards, int end,
              Outline& outline) {
  const Vector3d axis = placed.axis();
  outline.disc = placed.disc;
  outline.centre = placed.points[at(end)];
  outline.normal = end == 0 ? Vector3d(-axis) : axis;
  Vector3d rim =
      axis.cross(outward).norm() > kLevel ? placed.to_rim(outward) : placed.to_rim(towards);
  if (rim.isZero()) rim = placed.rotation.col(0) * placed.disc;
  const Vector3d quarter = outline.normal.cross(rim);
  outline.corners = {outline.centre + rim, outline.centre + quarter, outline.centre - rim,
                     outline.centre - quarter};
}

void set_face(const Placed& placed, int face, const Inner* inner, Outline& outline) {
  outline.normal = placed.normals[at(face)];
  const auto& corners = placed.convex->faces[at(face)].corners;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    outline.corners.push_back(placed.points[at(corners[k])]);
    if (inner == nullptr) continue;
    const int here = corners[k], next = corners[(k + 1) % corners.size()];
    outline.inner_corners[k] = inner->corners[at(here)];
    outline.inner_sides[k] = inner->sides[at((here + 1) % 3 == next ? here : next)];
  }
}

void set_cylinder(const Placed& placed, const Vector3d& outward, const Vector3d& towards, int face,
                  Outline& outline) {
  const double along = placed.axis().dot(outward);
  if (face >= 0 || std::abs(along) > std::numbers::sqrt2 / 2.0) {
    set_disc(placed, outward, towards, face >= 0 ? face : along > 0.0, outline);
    return;
  }
  for (const Vector3d& point : placed.points) {
    outline.corners.push_back(point + placed.to_rim(outward));
  }
}

// Where two sides cross, both beyond the tolerance.
void add_crossing(const Vector3d& a, const Vector3d& b, const Vector3d& c, const Vector3d& d,
                  double tolerance, std::vector<SharedPoint>& out) {
  const Vector2d along = (b - a).head<2>(), across = (d - c).head<2>();
  const double least_a = tolerance * along.norm(), least_c = tolerance * across.norm();
  const double c_side = cross(along, (c - a).head<2>()), d_side = cross(along, (d - a).head<2>());
  const double a_side = cross(across, (a - c).head<2>()), b_side = cross(across, (b - c).head<2>());
  if (std::min(std::abs(c_side), std::abs(d_side)) <= least_a || c_side * d_side >= 0.0) return;
  if (std::min(std::abs(a_side), std::abs(b_side)) <= least_c || a_side * b_side >= 0.0) return;
  const Vector3d first = a + (b - a) * (a_side / (a_side - b_side));
  const Vector3d second = c + (d - c) * (c_side / (c_side - d_side));
  out.push_back({first.head<2>(), first.z(), second.z()});
}

// Where a side crosses the rim of a disc: as seen from above, that is in the plane of the disc.
// `flipped`: the side is of the first.
void add_rim_crossings(const Outline& disc, const Vector3d& a, const Vector3d& b, bool flipped,
                       double tolerance, std::vector<SharedPoint>& out) {
  const auto lifted = [&](const Vector3d& x) {
    return Vector3d(x.x(), x.y(), disc.height(x.head<2>()));
  };
  const Vector3d from = lifted(a) - disc.centre, along = lifted(b) - lifted(a);
  const double length = along.norm();
  if (length <= tolerance) return;
  const Vector3d unit = along / length;
  const double foot = -from.dot(unit), away = (from + foot * unit).norm();
  if (away >= disc.disc - tolerance) return;
  const double half_chord = std::sqrt((disc.disc - away) * (disc.disc + away));
  for (const double way : {foot - half_chord, foot + half_chord}) {
    if (way <= tolerance || way >= length - tolerance) continue;
    const Vector3d rim = disc.centre + from + way * unit;
    const double side = a.z() + (b.z() - a.z()) * (way / length);
    out.push_back({rim.head<2>(), flipped ? side : rim.z(), flipped ? rim.z() : side});
  }
}

// Where the rims of two discs cross; of discs tilted against each other nothing but their highest
// points is near.
void add_disc_crossings(const Outline& first, const Outline& second, double tolerance,
                        std::vector<SharedPoint>& out) {
  if (first.normal.cross(second.normal).norm() > kCircles) return;
  const Vector2d apart = (second.centre - first.centre).head<2>();
  const double distance = apart.norm(), a = first.disc, b = second.disc;
  if (distance <= std::abs(a - b) + tolerance || distance >= a + b - tolerance) return;
  const double along = (distance * distance + a * a - b * b) / (2.0 * distance);
  const double half_chord = std::sqrt((a - along) * (a + along));
  const Vector2d unit = apart / distance, square(-unit.y(), unit.x());
  for (const double sign : {1.0, -1.0}) {
    const Vector2d place = first.centre.head<2>() + along * unit + sign * half_chord * square;
    out.push_back({place, first.height(place), second.height(place)});
  }
}

}  // namespace

std::size_t Outline::side_count() const {
  if (disc > 0.0) return 0;
  return flat() ? corners.size() : corners.size() - 1;
}

double Outline::height(const Vector2d& place) const {
  const Vector3d& known = disc > 0.0 ? centre : corners[0];
  return known.z() - normal.head<2>().dot(place - known.head<2>()) / normal.z();
}

bool Outline::holds(const Vector2d& place, double tolerance) const {
  if (!flat()) return false;
  if (disc > 0.0) {
    const Vector3d lifted(place.x(), place.y(), height(place));
    return (lifted - centre).norm() <= disc + tolerance;
  }
  const double turn = normal.z() > 0.0 ? 1.0 : -1.0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const Vector2d from = corners[k].head<2>();
    const Vector2d along = corners[(k + 1) % corners.size()].head<2>() - from;
    if (turn * cross(along, place - from) < -tolerance * along.norm()) return false;
  }
  return true;
}

void set_outline(const Placed& placed, const Vector3d& outward, int face, const Vector3d& towards,
                 const Inner* inner, const Eigen::Matrix3d& frame, Outline& outline) {
  outline.corners.clear();
  outline.disc = 0.0;
  outline.inner_corners.assign(placed.points.size() + 4, false);
  outline.inner_sides.assign(placed.points.size() + 4, false);
  if (placed.disc > 0.0) {
    set_cylinder(placed, outward, towards, face, outline);
  } else if (placed.normals.empty()) {
    outline.corners = placed.points;
  } else {
    if (face < 0) face = flattest_face_at_support(placed, outward);
    if (face >= 0) set_face(placed, face, inner, outline);
    if (face < 0) outline.corners.push_back(placed.support(outward));
  }
  for (Vector3d& corner : outline.corners) corner = frame.transpose() * corner;
  outline.normal = frame.transpose() * outline.normal;
  outline.centre = frame.transpose() * outline.centre;
}

void shared_points(const Outline& first, const Outline& second, double tolerance,
                   std::vector<SharedPoint>& out) {
  for (std::size_t k = 0; k < first.corners.size(); ++k) {
    const Vector3d& corner = first.corners[k];
    if (first.inner_corners[k] || !second.holds(corner.head<2>(), tolerance)) continue;
    out.push_back({corner.head<2>(), corner.z(), second.height(corner.head<2>())});
  }
  for (std::size_t k = 0; k < second.corners.size(); ++k) {
    const Vector3d& corner = second.corners[k];
    if (second.inner_corners[k] || !first.holds(corner.head<2>(), tolerance)) continue;
    out.push_back({corner.head<2>(), first.height(corner.head<2>()), corner.z()});
  }
  const auto side = [](const Outline& outline, std::size_t k) {
    return std::pair(outline.corners[k], outline.corners[(k + 1) % outline.corners.size()]);
  };
  for (std::size_t i = 0; i < first.side_count(); ++i) {
    const auto [a, b] = side(first, i);
    if (second.disc > 0.0) {
      if (!first.inner_sides[i]) add_rim_crossings(second, a, b, true, tolerance, out);
    }
    for (std::size_t j = 0; j < second.side_count(); ++j) {
      if (first.inner_sides[i] || second.inner_sides[j]) continue;
      const auto [c, d] = side(second, j);
      add_crossing(a, b, c, d, tolerance, out);
    }
  }
  if (first.disc == 0.0) return;
  for (std::size_t j = 0; j < second.side_count(); ++j) {
    const auto [c, d] = side(second, j);
    if (!second.inner_sides[j]) add_rim_crossings(first, c, d, false, tolerance, out);
  }
  if (second.disc > 0.0) add_disc_crossings(first, second, tolerance, out);
}

}  // namespace conebench::dem
