#include "tests/mpm/refined_helper.h"

#include <gtest/gtest.h>

namespace conebench::test {

using Eigen::Vector3d;
using mpm::Nodes;
using mpm::Scene;

Scene heap(int dim) {
  Scene scene = open_scene(dim == 2 ? std::vector{9, 8} : std::vector{7, 7, 6});
  scene.grid.refine = mpm::Refine::kBoundary;
  scene.grid.low_m = flat(dim, {-0.3, 0.2, 1.0});
  for (int a = 0; a < dim; ++a) scene.grid.size_m[a] *= 1.0 + 0.3 * a;
  mpm::Block& block = add_block(scene, Vector3d::Constant(1.0), Vector3d::Constant(5.0));
  block.jitter = 0.5;
  return scene;
}

void expect_both_kinds(const Nodes& nodes) {
  int whole = 0, half = 0;
  for (const int node : nodes.index) {
    const Eigen::Vector3i at = nodes.mesh.grid().place(node);
    const bool corner = ((at[0] | at[1] | at[2]) & 1) == 0;
    const double full = nodes.mesh.grid().node_volume(node);
    whole += corner && nodes.mesh.node_volume(node) > 1.1 * full;
    half += !corner;
  }
  ASSERT_GT(whole, 0);
  ASSERT_GT(half, 0);
}

}  // namespace conebench::test
