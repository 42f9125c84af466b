#include "dem/generators/clump.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "dem/generators/crowd.h"
#include "problems/engine/scene_file.h"

namespace conebench::dem {

using engine::Range;

Clump read_clump(engine::TomlReader in) {
  Clump clump;
  clump.centre_m = in.vector("centre_m");
  clump.radius_m = in.number("radius_m", Range::kPositive);
  clump.ball_radius_m = in.number("ball_radius_m", Range::kPositive);
  if (clump.ball_radius_m > clump.radius_m) {
    in.fail("ball_radius_m", fmt::format("found {}, expected at most radius_m = {}",
                                         clump.ball_radius_m, clump.radius_m));
  }
  clump.velocity_m_s = in.vector("velocity_m_s", clump.velocity_m_s);
  clump.material = in.text("material");
  in.finish();
  return clump;
}

std::string show(const Clump& clump) {
  return fmt::format(
      "\n[[clumps]]\ncentre_m = {}\nradius_m = {}\nball_radius_m = {}\nvelocity_m_s = {}\n"
      "material = {}\n",
      engine::show(clump.centre_m), clump.radius_m, clump.ball_radius_m,
      engine::show(clump.velocity_m_s), engine::quote(clump.material));
}

// Both lattices are every other point of a rectangular one: those with an even sum of indices.
void place(const Clump& clump, Nursery& nursery) {
  const bool flat = nursery.dimension() == 2;
  const double r = clump.ball_radius_m, side = r * std::numbers::sqrt2;
  const Eigen::Vector3d step =
      flat ? Eigen::Vector3d(r, 0.0, r * std::numbers::sqrt3) : Eigen::Vector3d::Constant(side);
  // Room for a ball is room for it, whatever its distance rounds to.
  const double reach = clump.radius_m - r + 1e-9 * r;
  check_crowd(std::pow(reach / r, flat ? 2 : 3), "clumps", nursery);
  const int most = static_cast<int>(reach / r);
  const int most_y = flat ? 0 : most;
  Seedling ball;
  ball.radius_m = r;
  ball.material = clump.material;
  ball.velocity_m_s = clump.velocity_m_s;
  for (int k = -most; k <= most; ++k) {
    for (int j = -most_y; j <= most_y; ++j) {
      for (int i = -most; i <= most; ++i) {
        const Eigen::Vector3d offset = Eigen::Vector3d(i, j, k).cwiseProduct(step);
        if ((i + j + k) % 2 != 0 || offset.norm() > reach) continue;
        ball.pose.position = clump.centre_m + offset;
        nursery.add(ball);
      }
    }
  }
}

}  // namespace conebench::dem
