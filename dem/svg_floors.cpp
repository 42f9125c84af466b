#include "dem/svg_floors.h"

#include <fmt/format.h>

#include <Eigen/SVD>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>

#include "dem/svg_light.h"

namespace conebench::dem {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kAround = 16;  // corners of the shadow of a circle
constexpr double kEdgeOn = 1e-9;
constexpr double kLeastRise = 0.3;   // of a floor's normal in the picture
constexpr double kLeastLight = 0.2;  // cosine, for shadows of less than five times a height

std::string points_of(const Contour& contour) {
  std::string out;
  for (const Vector2d& x : contour) {
    fmt::format_to(std::back_inserter(out), "{}{:.1f},{:.1f}", out.empty() ? "" : " ", x[0], x[1]);
  }
  return out;
}

std::string polygon(const Contour& ground) {
  return fmt::format("<polygon fill=\"#eceff1\" stroke=\"#b0bec5\" points=\"{}\"/>\n",
                     points_of(ground));
}

// Anticlockwise where y goes up. Method: Andrew's monotone chain (not checked).
Contour convex_hull(Contour points) {
  std::sort(points.begin(), points.end(), [](const Vector2d& a, const Vector2d& b) {
    return a[0] < b[0] || (a[0] == b[0] && a[1] < b[1]);
  });
  const auto turns_left = [](const Vector2d& a, const Vector2d& b, const Vector2d& c) {
    return (b[0] - a[0]) * (c[1] - b[1]) - (b[1] - a[1]) * (c[0] - b[0]) > 0.0;
  };
  Contour hull;
  for (int half = 0; half < 2; ++half) {
    const std::size_t start = hull.size();
    for (const Vector2d& x : points) {
      while (hull.size() >= start + 2 && !turns_left(hull[hull.size() - 2], hull.back(), x)) {
        hull.pop_back();
      }
      hull.push_back(x);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

}  // namespace

FloorsDrawing::FloorsDrawing(const Placement& start, const Frame& frame, const View& view,
                             const engine::Camera& camera)
    : start_(start),
      frame_(frame),
      view_(view),
      camera_(camera),
      picture_({{0.0, 0.0},
                {0.0, camera.height_px()},
                {camera.width_px(), camera.height_px()},
                {camera.width_px(), 0.0}}) {}

std::string FloorsDrawing::floors() const {
  std::string out;
  const Bodies& bodies = frame_.bodies;
  for (int k = 0; k < bodies.planes; ++k) {
    if (frame_.time_s >= start_.planes[static_cast<std::size_t>(k)].until_s) continue;
    const Pose pose = bodies.pose(bodies.count() + k);
    const Floor floor{pose.position, bodies.plane_normal(bodies.count() + k)};
    const Vector3d seen = view_.axes * floor.normal;
    if (std::abs(seen[2]) < kEdgeOn) {
      out += ground_behind(floor);
    } else if (seen[2] > 0.0 && seen[1] > kLeastRise) {
      out += ground_below(floor);
      if (!is_lit(floor)) continue;
      out += "<g fill=\"#37474f\" opacity=\"0.16\">\n";
      for (int i = 0; i < bodies.count(); ++i) {
        if (bodies.is_free(i)) out += shadow(floor, i);
      }
      out += "</g>\n";
    }
  }
  return out;
}

bool FloorsDrawing::is_lit(const Floor& floor) const {
  return to_light().dot(view_.axes * floor.normal) > kLeastLight;
}

// Where the light through x meets the floor.
Vector3d FloorsDrawing::cast(const Floor& floor, const Vector3d& x) const {
  const Vector3d light = view_.axes.transpose() * to_light();
  return x - floor.normal.dot(x - floor.point) / floor.normal.dot(light) * light;
}

std::string FloorsDrawing::ground_behind(const Floor& plane) const {
  const Vector2d point = camera_(plane.point);
  const Vector2d out = (camera_(plane.point - plane.normal) - point).normalized();
  const Vector2d along(out[1], -out[0]);
  const double far = (picture_[2] + point).norm();
  return polygon(clipped({point - far * along, point + far * along, point + far * (out + along),
                          point + far * (out - along)},
                         picture_));
}

// As wide as the picture and down to its end; upwards to behind where shadows fall.
std::string FloorsDrawing::ground_below(const Floor& floor) const {
  const Vector3d eye = view_.axes.row(2);
  const Vector3d away = (floor.normal * floor.normal.dot(eye) - eye).normalized();
  double far = -std::numeric_limits<double>::infinity();
  for (int k = 0; k < 8; ++k) {
    const Vector3d corner(k & 1 ? view_.high[0] : view_.low[0],
                          k & 2 ? view_.high[1] : view_.low[1],
                          k & 4 ? view_.high[2] : view_.low[2]);
    const Vector3d x = view_.axes.transpose() * corner;
    far = std::max(far, away.dot(x - floor.point));
    if (is_lit(floor)) far = std::max(far, away.dot(cast(floor, x) - floor.point));
  }
  const Vector3d middle = view_.axes.transpose() * (0.5 * (view_.low + view_.high));
  const Vector3d below = middle - away * away.dot(middle - floor.point) -
                         floor.normal * floor.normal.dot(middle - floor.point);
  const double whole = (camera_.width_px() + camera_.height_px()) / camera_.scale();
  const Vector3d front = below - whole / floor.normal.dot(eye) * away, back = below + far * away;
  const Vector3d aside = whole * away.cross(floor.normal);
  return polygon(clipped({camera_(front - aside), camera_(front + aside), camera_(back + aside),
                          camera_(back - aside)},
                         picture_));
}

std::string FloorsDrawing::shadow(const Floor& floor, int body) const {
  const Bodies& bodies = frame_.bodies;
  const auto b = static_cast<std::size_t>(body);
  if (bodies.is_ball(body)) return shadow_of_ball(floor, bodies.position[b], bodies.radius[b]);
  std::string out;
  for (const Part& part : start_.solids[static_cast<std::size_t>(bodies.solid[b])].parts) {
    const Pose pose = bodies.pose(body) * part.pose;
    const auto* ball = std::get_if<Ball>(&part.piece);
    out += ball ? shadow_of_ball(floor, pose.position, ball->radius_m)
                : shadow_of_piece(floor, part.piece, pose);
  }
  return out;
}

// The picture of a disc across the light: the axes of the ellipse are the singular vectors of the
// map that takes the unit circle there.
std::string FloorsDrawing::shadow_of_ball(const Floor& floor, const Vector3d& centre_m,
                                          double radius_m) const {
  const Vector3d light = view_.axes.transpose() * to_light();
  const Vector3d first = light.unitOrthogonal(), second = light.cross(first);
  const Vector2d at = camera_(cast(floor, centre_m));
  Eigen::Matrix2d map;
  map.col(0) = camera_(cast(floor, centre_m + radius_m * first)) - at;
  map.col(1) = camera_(cast(floor, centre_m + radius_m * second)) - at;
  const Eigen::JacobiSVD<Eigen::Matrix2d> svd(map, Eigen::ComputeFullU);
  const Vector2d radii = svd.singularValues(), axis = svd.matrixU().col(0);
  return fmt::format(
      "<ellipse cx=\"{0:.1f}\" cy=\"{1:.1f}\" rx=\"{2:.1f}\" ry=\"{3:.1f}\" "
      "transform=\"rotate({4:.1f} {0:.1f} {1:.1f})\"/>\n",
      at[0], at[1], radii[0], radii[1], std::atan2(axis[1], axis[0]) * 180.0 / std::numbers::pi);
}

std::string FloorsDrawing::shadow_of_piece(const Floor& floor, const Piece& piece,
                                           const Pose& pose) const {
  Contour points;
  for (const Vector3d& x : facets(piece, kAround).vertices) {
    points.push_back(camera_(cast(floor, pose * x)));
  }
  return fmt::format("<polygon points=\"{}\"/>\n", points_of(convex_hull(std::move(points))));
}

}  // namespace conebench::dem
