// Free bodies as a heap of balls.

#include "dem/heap.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/dem/scene_helper.h"
#include "tests/engine/small_solver.h"

namespace conebench::test {
namespace {

using Eigen::Vector3d;

TEST(BodiesAsAHeap, AreThoseThatCanMoveEachAsABallOfItsVolume) {
  dem::Scene scene = small_scene({.friction = 0.5});
  add_floor(scene);
  add_body(scene, {0, 0, 1}, 0.1);
  add_body(scene, {1, 0, 1}, 0.2).fixed = true;
  add_shape(scene, "box", dem::Box{.half_m = {0.1, 0.1, 0.2}});
  add_body(scene, {3, 0, 1}, "box");
  const engine::Heap heap = dem::heap_of(dem::Simulation(scene, small_solver()));
  ASSERT_EQ(heap.grains.size(), 2u);
  EXPECT_DOUBLE_EQ(heap.grains[0].radius, 0.1);
  const double box_m3 = 0.2 * 0.2 * 0.4;
  EXPECT_NEAR(heap.grains[1].radius, std::cbrt(0.75 / std::numbers::pi * box_m3), 1e-12);
  EXPECT_NEAR(heap.grains[1].mass, 2500.0 * box_m3, 1e-9);
  EXPECT_TRUE(heap.grains[1].position.isApprox(Vector3d(3, 0, 1)));
  EXPECT_DOUBLE_EQ(heap.cell_m, 1.5 * (heap.grains[0].radius + heap.grains[1].radius));
}

}  // namespace
}  // namespace conebench::test
