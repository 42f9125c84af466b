#include "mpm/scene_check.h"

#include <fmt/format.h>

#include <cmath>

namespace conebench::mpm {
namespace {

using engine::show;
using engine::TomlReader;

// Two places this close are one [cells].
constexpr double kSame = 1e-6;

constexpr int kNoAxis = -1;

void check_inside(const TomlReader& in, std::string_view key, const Grid& grid,
                  const Eigen::Vector3d& x, std::string_view otherwise) {
  const Eigen::Vector3d high = grid.low_m + grid.size_m;
  for (int a = 0; a < grid.dim; ++a) {
    const double slack = kSame * grid.spacing(a);
    if (x[a] >= grid.low_m[a] - slack && x[a] <= high[a] + slack) continue;
    in.fail(key, fmt::format("found {}, expected a point of the grid, from {} to {}: {}",
                             show(x, grid.dim), show(grid.low_m, grid.dim), show(high, grid.dim),
                             otherwise));
  }
}

// low < high on every axis but `skipped`.
void check_order(const TomlReader& in, int dim, const Eigen::Vector3d& low,
                 const Eigen::Vector3d& high, int skipped) {
  for (int a = 0; a < dim; ++a) {
    if (a == skipped || low[a] < high[a]) continue;
    in.fail("high_m", fmt::format("found {} on axis {}, expected > {}, which low_m has there",
                                  high[a], "xyz"[a], low[a]));
  }
}

void check_on_nodes(const TomlReader& in, const Grid& grid, const Barrier& barrier) {
  const int a = barrier.axis, last = grid.cells[a] - 1;
  if (last < 1) {
    in.fail("axis", fmt::format("found {0}, expected an axis with planes of nodes inside the grid: "
                                "there is one cell along {0}",
                                "xyz"[a]));
  }
  const auto plane = [&](double k) { return grid.low_m[a] + k * grid.spacing(a); };
  const double place = (barrier.position_m - grid.low_m[a]) / grid.spacing(a);
  const double nearest = std::clamp(std::round(place), 1.0, static_cast<double>(last));
  if (std::abs(place - nearest) <= kSame) return;
  const double below = std::clamp(std::floor(place), 1.0, static_cast<double>(last));
  const double above = std::clamp(std::ceil(place), 1.0, static_cast<double>(last));
  in.fail(
      "position_m",
      fmt::format("found {}, expected a plane of nodes inside the grid; the nearest {} {:.10g}{}",
                  barrier.position_m, below == above ? "is" : "are", plane(below),
                  below == above ? "" : fmt::format(" and {:.10g}", plane(above))));
}

void check_opening(const TomlReader& in, const Eigen::Vector3d& gravity, const Barrier& barrier) {
  if (barrier.opening_m_s == 0.0) return;
  if (!std::isfinite(barrier.opens_s)) {
    in.fail("opening_m_s", fmt::format("found {} without opens_s, expected the two together",
                                       barrier.opening_m_s));
  }
  const auto axes = (gravity.array() != 0.0).count();
  if (axes != 1 || gravity[barrier.axis] != 0.0) {
    in.fail("opening_m_s",
            fmt::format("found {} where gravity_m_s2 = {}, expected gravity along an axis other "
                        "than the barrier's, {}: the barrier rises against it",
                        barrier.opening_m_s, show(gravity), "xyz"[barrier.axis]));
  }
}

bool overlap(const Grid& grid, const Block& a, const Block& b) {
  for (int axis = 0; axis < grid.dim; ++axis) {
    const double common =
        std::min(a.high_m[axis], b.high_m[axis]) - std::max(a.low_m[axis], b.low_m[axis]);
    if (common <= kSame * grid.spacing(axis)) return false;
  }
  return true;
}

void check_thickness(const TomlReader& in, const Grid& grid, const Body& body) {
  if (body.shape == Shape::kHalfSpace) return;
  const bool is_ball = body.shape == Shape::kBall;
  const double half = is_ball ? body.radius_m : body.half_size_m.head(grid.dim).minCoeff();
  double cell = grid.spacing(0);
  for (int a = 1; a < grid.dim; ++a) cell = std::max(cell, grid.spacing(a));
  if (half >= (1.0 - kSame) * cell) return;
  in.fail(
      is_ball ? "radius_m" : "half_size_m",
      fmt::format("found {}, expected at least {}: the grid cannot see a body that is less than "
                  "two cells thick",
                  half, cell));
}

void check_planar(const TomlReader& in, std::string_view key, int dim, const Eigen::Vector3d& x) {
  if (dim == 3 || (x[0] == 0.0 && x[1] == 0.0)) return;
  in.fail(key, fmt::format("found {}, expected [0, 0, angle] in two dimensions", show(x)));
}

void check_at_rest(const TomlReader& in, std::string_view key, const Eigen::Vector3d& x) {
  if (x.isZero(0.0)) return;
  in.fail(key, fmt::format("found {}, expected zeros: a static body does not move", show(x)));
}

}  // namespace

void check_barrier(const TomlReader& in, const Scene& scene, const Barrier& barrier) {
  constexpr std::string_view kOtherwise = "a barrier cannot cross a wall";
  check_on_nodes(in, scene.grid, barrier);
  check_inside(in, "low_m", scene.grid, barrier.low_m, kOtherwise);
  check_inside(in, "high_m", scene.grid, barrier.high_m, kOtherwise);
  check_order(in, scene.grid.dim, barrier.low_m, barrier.high_m, barrier.axis);
  check_opening(in, scene.gravity_m_s2, barrier);
}

void check_block(const TomlReader& in, const Scene& scene, const Block& block) {
  constexpr std::string_view kOtherwise = "these particles would be outside";
  check_inside(in, "low_m", scene.grid, block.low_m, kOtherwise);
  check_inside(in, "high_m", scene.grid, block.high_m, kOtherwise);
  check_order(in, scene.grid.dim, block.low_m, block.high_m, kNoAxis);
  if (block.fraction > scene.material.phi_max) {
    in.fail("fraction", fmt::format("found {}, expected at most material.phi_max, {}",
                                    block.fraction, scene.material.phi_max));
  }
  for (std::size_t i = 0; i < scene.blocks.size(); ++i) {
    const Block& other = scene.blocks[i];
    if (!overlap(scene.grid, block, other)) continue;
    const int dim = scene.grid.dim;
    in.fail("low_m", fmt::format("found {} to {}, expected no volume in common with blocks[{}], "
                                 "{} to {}",
                                 show(block.low_m, dim), show(block.high_m, dim), i,
                                 show(other.low_m, dim), show(other.high_m, dim)));
  }
}

void check_body(const TomlReader& in, const Grid& grid, const Body& body) {
  check_thickness(in, grid, body);
  check_planar(in, "rotation_rad", grid.dim, body.rotation_rad);
  check_planar(in, "angular_velocity_rad_s", grid.dim, body.angular_velocity_rad_s);
  if (body.motion == Motion::kStatic) {
    check_at_rest(in, "velocity_m_s", body.velocity_m_s);
    check_at_rest(in, "angular_velocity_rad_s", body.angular_velocity_rad_s);
  }
  if (body.motion == Motion::kFree && body.shape == Shape::kHalfSpace) {
    in.fail("motion",
            "found \"free\", expected \"static\" or \"driven\": a half space has no mass");
  }
}

}  // namespace conebench::mpm
