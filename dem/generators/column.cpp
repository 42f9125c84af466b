#include "dem/generators/column.h"

#include <fmt/format.h>

#include <algorithm>

#include "dem/generators/crowd.h"
#include "problems/engine/scene_file.h"

namespace conebench::dem {

using engine::Range;

Column read_column(engine::TomlReader in) {
  Column column;
  static const std::string kSections[] = {"box", "cylinder"};
  column.section = in.word("section", kSections, "box") == 0 ? Section::kBox : Section::kCylinder;
  column.base_m = in.vector("base_m", column.base_m);
  column.width_m = in.number("width_m", Range::kPositive);
  column.height_m = in.number("height_m", Range::kPositive);
  const Eigen::Vector2d radii = in.interval("radius_range_m", Range::kPositive);
  column.smallest_radius_m = radii[0];
  column.largest_radius_m = radii[1];
  column.jitter = in.number("jitter", Range::kUnitInterval, column.jitter);
  column.material = in.text("material");
  if (std::min(column.width_m, column.height_m) < 2.0 * column.largest_radius_m) {
    in.fail("radius_range_m", "the largest sphere does not fit into width_m x height_m");
  }
  in.finish();
  return column;
}

std::string show(const Column& column) {
  return fmt::format(
      "\n[[columns]]\nsection = \"{}\"\nbase_m = {}\nwidth_m = {}\nheight_m = {}\n"
      "radius_range_m = [{}, {}]\njitter = {}\nmaterial = {}\n",
      column.section == Section::kBox ? "box" : "cylinder", engine::show(column.base_m),
      column.width_m, column.height_m, column.smallest_radius_m, column.largest_radius_m,
      column.jitter, engine::quote(column.material));
}

void place(const Column& column, Nursery& nursery) {
  const double largest = column.largest_radius_m;
  const double cell = 2.0 * largest;
  // Room for n cells is room for n, whatever the quotient rounds to.
  const auto cells_in = [&](double length) { return static_cast<int>(length / cell + 1e-9); };
  const double across = column.width_m / cell;
  check_crowd(across * (nursery.dimension() == 2 ? 1.0 : across) * column.height_m / cell,
              "columns", nursery);
  const int side = cells_in(column.width_m);
  const int rows = nursery.dimension() == 2 ? 1 : side;
  const int layers = cells_in(column.height_m);
  const double reach = 0.5 * column.width_m - largest + 1e-9 * largest;
  for (int layer = 0; layer < layers; ++layer) {
    for (int row = 0; row < rows; ++row) {
      for (int place = 0; place < side; ++place) {
        const Eigen::Vector3d centre((place - 0.5 * (side - 1)) * cell,
                                     (row - 0.5 * (rows - 1)) * cell, (layer + 0.5) * cell);
        if (column.section == Section::kCylinder && centre.head<2>().norm() > reach) continue;
        Seedling ball;
        ball.radius_m =
            column.smallest_radius_m + (largest - column.smallest_radius_m) * nursery.random();
        const double room = column.jitter * (largest - ball.radius_m);
        for (int k = 0; k < 3; ++k) {
          const double move = room * (2.0 * nursery.random() - 1.0);
          ball.pose.position[k] =
              column.base_m[k] + centre[k] + (k == 1 && nursery.dimension() == 2 ? 0.0 : move);
        }
        ball.material = column.material;
        nursery.add(ball);
      }
    }
  }
}

}  // namespace conebench::dem
