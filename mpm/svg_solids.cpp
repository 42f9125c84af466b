#include "mpm/svg_solids.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "mpm/walls.h"

namespace conebench::mpm {
namespace {

using Polygon = std::vector<Eigen::Vector3d>;

constexpr double kLeastCell_px = 8.0;
constexpr auto kGrey = "#b0bec5";

// The part of a polygon where normal . (x - point) <= 0.
Polygon clipped(const Polygon& polygon, const Eigen::Vector3d& normal,
                const Eigen::Vector3d& point) {
  Polygon out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double at_a = normal.dot(a - point), at_b = normal.dot(b - point);
    if (at_a <= 0.0) out.push_back(a);
    if ((at_a < 0.0) != (at_b < 0.0) && at_a != at_b) {
      out.push_back(a + at_a / (at_a - at_b) * (b - a));
    }
  }
  return out;
}

std::string_view stroke_of(Condition condition) {
  switch (condition) {
    case Condition::kStick:
      return "stroke=\"#263238\" stroke-width=\"5\"";
    case Condition::kSlip:
      return "stroke=\"#607d8b\" stroke-width=\"1.5\"";
    case Condition::kFrictional:
      return "stroke=\"#263238\" stroke-width=\"3\" stroke-dasharray=\"9 4\"";
    case Condition::kFree:
      break;
  }
  return "stroke=\"none\"";
}

}  // namespace

engine::Window window_of(const Scene& scene) {
  const Grid& grid = scene.grid;
  engine::Window window;
  if (grid.dim == 3) window.axes = engine::oblique_axes(scene.gravity_m_s2);
  window.low.setConstant(std::numeric_limits<double>::infinity());
  window.high = -window.low;
  for (int k = 0; k < 8; ++k) {
    const Eigen::Vector3d share(k & 1, (k >> 1) & 1, (k >> 2) & 1);
    const Eigen::Vector3d at = window.axes * (grid.low_m + share.cwiseProduct(grid.size_m));
    window.low = window.low.cwiseMin(at);
    window.high = window.high.cwiseMax(at);
  }
  window.widen();
  return window;
}

SolidsDrawing::SolidsDrawing(const Scene& scene, const engine::Camera& camera)
    : scene_(scene),
      camera_(camera),
      low_(scene.grid.low_m),
      high_(scene.grid.low_m + scene.grid.size_m) {}

std::string SolidsDrawing::behind(const std::vector<RigidBody>& bodies,
                                  const std::vector<bool>& cut) const {
  std::string out = cell_lines(cut);
  for (const RigidBody& body : bodies) {
    if (body.body.shape != Shape::kHalfSpace) continue;
    out += fmt::format("<path fill=\"{}\" d=\"{}\"/>\n", kGrey, path(half_space(body)));
  }
  return out + walls();
}

std::string SolidsDrawing::barrier(const Barrier& barrier, double time_s) const {
  const Grid& grid = scene_.grid;
  Eigen::Vector3i cells = grid.cells.cwiseMax(1);
  cells[barrier.axis] = 1;
  std::string faces;
  for (int k = 0; k < cells.prod(); ++k) {
    const Eigen::Vector3i at(k % cells[0], k / cells[0] % cells[1], k / (cells[0] * cells[1]));
    Eigen::Vector3d low = low_, high = low_;
    for (int a = 0; a < grid.dim; ++a) {
      low[a] += at[a] * grid.spacing(a);
      high[a] = low[a] + grid.spacing(a);
    }
    const Eigen::Vector3d middle = 0.5 * (low + high);
    if (!covers(barrier, scene_.gravity_m_s2, grid.dim, middle, time_s)) continue;
    faces += path(rectangle(barrier.axis, barrier.position_m, low, high));
  }
  if (faces.empty()) return {};
  return fmt::format("<path fill=\"#607d8b\" fill-opacity=\"0.3\" {} d=\"{}\"/>\n",
                     grid.dim == 2 ? stroke_of(barrier.condition) : "", faces);
}

std::string SolidsDrawing::body(const RigidBody& body) const {
  if (body.body.shape == Shape::kHalfSpace) return {};
  if (body.body.shape == Shape::kBox) return box(body);
  const Eigen::Vector2d at = camera_(body.centre_m);
  return fmt::format(
      "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\" stroke=\"#607d8b\"/>\n", at[0],
      at[1], camera_.scale() * body.body.radius_m, kGrey);
}

// The faces that the eye sees, those that face it the brightest; in 2D the only one.
std::string SolidsDrawing::box(const RigidBody& body) const {
  const Eigen::Matrix3d axes =
      body.orientation.toRotationMatrix() * body.body.half_size_m.asDiagonal();
  std::string out;
  for (int a = 0; a < 3; ++a) {
    const Eigen::Vector3d towards = body.orientation * Eigen::Vector3d::Unit(a);
    const double facing = camera_.depth(towards);
    if (std::abs(facing) < 1e-9) continue;
    const Eigen::Vector3d middle = body.centre_m + (facing > 0.0 ? 1.0 : -1.0) * axes.col(a);
    const Eigen::Vector3d b = axes.col((a + 1) % 3), c = axes.col((a + 2) % 3);
    const engine::Colour shade = (0.7 + 0.3 * std::abs(facing)) * engine::Colour(176, 190, 197);
    out += fmt::format("<path fill=\"{}\" stroke=\"#607d8b\" d=\"{}\"/>\n", engine::hex(shade),
                       path({middle - b - c, middle + b - c, middle + b + c, middle - b + c}));
  }
  return out;
}

std::string SolidsDrawing::path(const Polygon& polygon) const {
  std::string out;
  for (const Eigen::Vector3d& x : polygon) {
    const Eigen::Vector2d at = camera_(x);
    out += fmt::format("{}{:.1f} {:.1f}", out.empty() ? "M" : "L", at[0], at[1]);
  }
  return out.empty() ? out : out + "Z";
}

// Corners of the rectangle from low to high on the plane x[axis] = place; the ends of a line in 2D.
Polygon SolidsDrawing::rectangle(int axis, double place, const Eigen::Vector3d& low,
                                 const Eigen::Vector3d& high) const {
  const int b = (axis + 1) % 3, c = (axis + 2) % 3;
  Polygon corners;
  for (const auto& [at_b, at_c] : {std::pair(low[b], low[c]), std::pair(high[b], low[c]),
                                   std::pair(high[b], high[c]), std::pair(low[b], high[c])}) {
    Eigen::Vector3d x;
    x[axis] = place;
    x[b] = at_b;
    x[c] = at_c;
    if (corners.empty() || x != corners.back()) corners.push_back(x);
  }
  return corners;
}

// What the grid sees of it: its inside in 2D, its surface in 3D.
Polygon SolidsDrawing::half_space(const RigidBody& body) const {
  const Eigen::Vector3d normal = body.orientation * body.body.normal;
  if (scene_.grid.dim == 2) {
    return clipped(rectangle(2, 0.0, low_, high_), normal, body.centre_m);
  }
  const Eigen::Vector3d u = (high_ - low_).norm() * normal.unitOrthogonal(), v = normal.cross(u);
  const Eigen::Vector3d grid_middle = 0.5 * (low_ + high_);
  const Eigen::Vector3d middle = grid_middle - normal.dot(grid_middle - body.centre_m) * normal;
  Polygon patch = {middle - u - v, middle + u - v, middle + u + v, middle - u + v};
  for (int a = 0; a < 3; ++a) {
    patch = clipped(patch, -Eigen::Vector3d::Unit(a), low_);
    patch = clipped(patch, Eigen::Vector3d::Unit(a), high_);
  }
  return patch;
}

std::string SolidsDrawing::cell_lines(const std::vector<bool>& cut) const {
  const Grid& grid = scene_.grid;
  if (grid.dim == 3 || camera_.scale() * grid.smallest_spacing() < kLeastCell_px) return {};
  std::string lines;
  for (int a = 0; a < 2; ++a) {
    for (int k = 1; k < grid.cells[a]; ++k) {
      lines += path(rectangle(a, low_[a] + k * grid.spacing(a), low_, high_));
    }
  }
  const Eigen::Vector3d size(grid.spacing(0), grid.spacing(1), 0.0);
  for (std::size_t cell = 0; cell < cut.size(); ++cell) {
    if (!cut[cell]) continue;
    const Eigen::Vector3d at = grid.cell_place(static_cast<int>(cell)).cast<double>();
    const Eigen::Vector3d low = low_ + at.cwiseProduct(size), high = low + size;
    for (int a = 0; a < 2; ++a) lines += path(rectangle(a, 0.5 * (low[a] + high[a]), low, high));
  }
  return fmt::format("<path stroke=\"#e0e4e7\" stroke-width=\"0.5\" d=\"{}\"/>\n", lines);
}

// In 3D those behind the material, and their ground filled.
std::string SolidsDrawing::walls() const {
  std::string out;
  for (int a = 0; a < scene_.grid.dim; ++a) {
    for (const bool high : {false, true}) {
      const Eigen::Vector3d inward = (high ? -1.0 : 1.0) * Eigen::Vector3d::Unit(a);
      const Condition condition = scene_.wall(a, high).condition;
      const bool hidden = scene_.grid.dim == 3 && camera_.depth(inward) <= 0.0;
      if (hidden || condition == Condition::kFree) continue;
      const bool floor = scene_.grid.dim == 3 && inward.dot(scene_.gravity_m_s2) < 0.0;
      out += fmt::format("<path fill=\"{}\" {} d=\"{}\"/>\n", floor ? "#eceff1" : "none",
                         stroke_of(condition),
                         path(rectangle(a, high ? high_[a] : low_[a], low_, high_)));
    }
  }
  return out;
}

}  // namespace conebench::mpm
