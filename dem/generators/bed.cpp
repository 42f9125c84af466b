#include "dem/generators/bed.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "dem/generators/crowd.h"
#include "problems/engine/scene_file.h"

namespace conebench::dem {

using engine::Range;

Bed read_bed(engine::TomlReader in) {
  Bed bed;
  bed.centre_m = in.vector("centre_m", bed.centre_m);
  bed.width_m = in.number("width_m", Range::kPositive);
  bed.radius_m = in.number("radius_m", Range::kPositive);
  bed.material = in.text("material");
  in.finish();
  return bed;
}

std::string show(const Bed& bed) {
  return fmt::format("\n[[beds]]\ncentre_m = {}\nwidth_m = {}\nradius_m = {}\nmaterial = {}\n",
                     engine::show(bed.centre_m), bed.width_m, bed.radius_m,
                     engine::quote(bed.material));
}

void place(const Bed& bed, Nursery& nursery) {
  const double cell = 2.0 * bed.radius_m;
  const double across = bed.width_m / cell;
  check_crowd(nursery.dimension() == 2 ? across : across * across, "beds", nursery);
  const int side = std::max(1, static_cast<int>(std::ceil(bed.width_m / cell - 1e-9)));
  const int rows = nursery.dimension() == 2 ? 1 : side;
  Seedling ball;
  ball.radius_m = bed.radius_m;
  ball.material = bed.material;
  ball.fixed = true;
  for (int k = 0; k < side * rows; ++k) {
    ball.pose.position = bed.centre_m;
    ball.pose.position.x() += (k % side - 0.5 * (side - 1)) * cell;
    ball.pose.position.y() += (k / side - 0.5 * (rows - 1)) * cell;
    nursery.add(ball);
  }
}

}  // namespace conebench::dem
